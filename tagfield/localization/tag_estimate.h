// SPDX-License-Identifier: Apache-2.0
/// @file
/// What localization says of one tag.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

enum class Verdict {
  kLocated,     ///< One candidate.
  kAmbiguous,   ///< Several that the data can't tell apart, such as the two mirror images.
  kNotLocated,  ///< None; `reason` is "cannot localize: " and why.
};

/// "located", "ambiguous", "not_located".
std::string to_string(Verdict verdict);
/// Inverse of to_string; throws Error on another word.
Verdict verdict_from_string(const std::string& word);

/// A place where the tag may be.
struct Candidate {
  Eigen::Vector3d p_WT;           ///< [m]
  double rms_m = 0.0;             ///< Quality E: rms misfit of the unwrapped phase distance [m].
  double expected_error_m = 0.0;  ///< Root of the horizontal covariance's trace [m].
  /// Covariance of p_WT [m²], of methods that tell it; rows of z are 0 where the height was given.
  std::optional<Eigen::Matrix3d> covariance{};
};

struct TagEstimate {
  std::string tag;
  Verdict verdict = Verdict::kNotLocated;
  std::string reason;                 ///< One line; empty where located.
  std::vector<Candidate> candidates;  ///< Best first.
  std::size_t reads = 0;              ///< Reads of this tag that were used.
};

}  // namespace tagfield
