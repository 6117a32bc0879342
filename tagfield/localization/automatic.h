// SPDX-License-Identifier: Apache-2.0
/// @file
/// Choice of a localization method by the data.
#pragma once

#include <vector>

#include "tagfield/localization/method.h"

namespace tagfield {

/// Properties of the data that decide which method is used.
struct DataTraits {
  bool antennas_move = false;  ///< At least one moves.
  bool has_reads = false;      ///< Some tag has enough for a fit.
  bool has_phases = true;
  bool pose_is_exact = false;  ///< The pose error is known to be 0.
  double short_scans = 0.0;    ///< Share of reads from a straight path of at most 3 m.
  /// Share of those reads from tags whose residuals at the best position are more than noise.
  double unexplained = 0.0;
  /// Share of all reads from tags whose residuals at the best position are more than noise.
  double bent = 0.0;
  std::size_t antennas = 0;        ///< Largest number that read one tag.
  std::size_t channels = 0;        ///< Number of carriers.
  double reads_per_segment = 0.0;  ///< Mean number of reads over which the phase can be unwrapped.
  /// Share of reads that can be unwrapped; noise may leave none of a tag's.
  double followed = 1.0;
  /// Misfit of individually fitted tags divided by their phase noise, median over tags; about 1 if
  /// there is only noise. Reflections and pose errors increase it.
  double misfit = 0.0;
  double noise_m = 0.0;       ///< Of a single read, median over tags.
  bool has_outliers = false;  ///< Most of the reads are from tags with outliers.
};

/// Examines up to 20 tags.
DataTraits traits_of(const LocalizationProblem& problem, int threads);

/// The method to use for such data, and the reason in one line.
struct Choice {
  std::string method;
  std::string why;
};
Choice choose_method(const DataTraits& traits, std::size_t reference_tags);

struct AutomaticOptions {
  /// Whether a known world is used (LocalizationProblem::trace).
  bool known_world = true;
  /// Whether it was requested explicitly, so that a missing one is reported.
  bool wants_known_world = false;
};

/// "auto": chooses one of `methods` and runs it. If "joint" leaves a misfit over 1.6 times the
/// noise, falls back to "robust".
Method automatic_method(const std::vector<Method>& methods);

}  // namespace tagfield
