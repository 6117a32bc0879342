// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a tag's reads along a straight scan tell of the field there: one complex number a place of
/// the antenna, all channels together.
#pragma once

#include <Eigen/Core>
#include <string>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// The line along which an antenna was moved, seen from above.
struct ScanLine {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< Unit vector.
  [[nodiscard]] Eigen::Vector2d left() const { return {-along.y(), along.x()}; }
};

/// The field at the antenna as a tag sends it back, one way: the root of what is read, there and
/// back alike. Phase grows with distance by `wavenumber`.
struct ScanField {
  std::string why_not;  ///< Why there is none; empty where there is.
  ScanLine line;
  double begin_m = 0.0;     ///< First and last place of the antenna along the line,
  double end_m = 0.0;       ///< from its middle [m].
  double wavenumber = 0.0;  ///< One way, of the middle channel [rad/m].
  double up_m = 0.0;        ///< The tag above the antenna [m].
  Eigen::ArrayXd along_m;   ///< Places of the antenna along the line, from its middle, rising [m].
  Eigen::ArrayXcd field;    ///< There, of norm 1 over all.
  double samples = 0.0;     ///< So many independent ones the field has at most.
};

/// A longer one sees too many reflections for one second path [m].
inline constexpr double kLongestScan = 3.0;

/// Of the antenna with most places on a straight way. Reads within λ/20 of the way are one place.
/// Channels have an offset each, at which they agree best. Along the places the phase is followed;
/// of several stretches without longer gaps than λ/4 the longest counts.
ScanField scan_field(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples);

}  // namespace tagfield
