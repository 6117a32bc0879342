// SPDX-License-Identifier: Apache-2.0
/// @file
/// The method that the data ask for.
#pragma once

#include <vector>

#include "tagfield/localization/method.h"

namespace tagfield {

/// What of the data decides.
struct DataTraits {
  bool antennas_move = false;  ///< Any.
  bool has_reads = false;      ///< Some tag has as many as a fit needs.
  bool has_phases = true;
  bool pose_is_exact = false;  ///< The pose error is known to be 0.
  double short_scans = 0.0;    ///< Share of reads from a straight way of at most 3 m,
  double unexplained = 0.0;  ///< and of those the share whose misfit at the best place is no noise.
  double bent = 0.0;  ///< Share of all reads from tags whose misfit at the best place is no noise.
  std::size_t antennas = 0;      ///< Most that read a tag.
  std::size_t channels = 0;      ///< Carriers.
  double reads_a_stretch = 0.0;  ///< Reads over which the phase can be followed, in the mean.
  double followed = 1.0;  ///< Share of reads over which it can: noise may leave none of a tag.
  /// Misfit of tags fitted by themselves over what their phase noise alone would leave, the median
  /// over tags; 1 where reads are but noisy. Reflections and pose errors make it greater.
  double misfit = 0.0;
  double noise_m = 0.0;       ///< Of one read, the median over tags.
  bool has_outliers = false;  ///< Most tags that might be located have some.
};

/// Looks at up to 20 tags.
DataTraits traits_of(const LocalizationProblem& problem, int threads);

/// What to use for such data, and why, in one line.
struct Choice {
  std::string method;
  std::string why;
};
Choice choose_method(const DataTraits& traits, std::size_t reference_tags);

struct AutomaticOptions {
  /// Whether use is made of a world that is known (LocalizationProblem::trace).
  bool known_world = true;
  bool wants_known_world = false;  ///< Whether that was asked for, and it matters if there is none.
};

/// "auto": chooses among `methods` and runs the chosen one. Where "joint" leaves a misfit over 1.6
/// times the noise, "robust" is taken after all.
Method automatic_method(const std::vector<Method>& methods);

}  // namespace tagfield
