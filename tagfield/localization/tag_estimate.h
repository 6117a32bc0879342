// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization result for one tag.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

enum class Verdict {
  kLocated,     ///< One candidate.
  kAmbiguous,   ///< Several that the data can't distinguish, such as two mirror images.
  kNotLocated,  ///< None; `reason` is "cannot localize: " followed by the cause.
};

/// "located", "ambiguous", "not_located".
std::string to_string(Verdict verdict);
/// Inverse of to_string; throws Error on any other word.
Verdict verdict_from_string(const std::string& word);

/// A possible position of the tag.
struct Candidate {
  Eigen::Vector3d p_WT;           ///< [m]
  double rms_m = 0.0;             ///< Quality E: rms misfit of the unwrapped phase distance [m].
  double expected_error_m = 0.0;  ///< Square root of the horizontal covariance's trace [m].
  /// Covariance of p_WT [m²], from methods that provide it; rows of z are 0 if the height was
  /// given.
  std::optional<Eigen::Matrix3d> covariance{};
};

struct TagEstimate {
  std::string tag;
  Verdict verdict = Verdict::kNotLocated;
  std::string reason;                 ///< One line; empty if located.
  std::vector<Candidate> candidates;  ///< Best first.
  std::size_t reads = 0;              ///< Reads of this tag that were used.
};

}  // namespace tagfield
