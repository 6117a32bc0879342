// SPDX-License-Identifier: Apache-2.0
/// @file
/// Field of a tag along a straight scan, from its reads: one complex number per antenna position,
/// all channels combined.
#pragma once

#include <Eigen/Core>
#include <string>

#include "tagfield/localization/problem.h"

namespace tagfield {

/// The line along which an antenna moved, in the horizontal plane.
struct ScanLine {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();  ///< [m]
  Eigen::Vector2d along = Eigen::Vector2d::UnitX();  ///< Unit vector.
  [[nodiscard]] Eigen::Vector2d left() const { return {-along.y(), along.x()}; }
};

/// One-way field between a tag and the antenna: the square root of the measured round trip, as both
/// directions are alike. Phase grows with distance by `wavenumber`.
struct ScanField {
  std::string why_not;  ///< Why there is no field; empty if there is one.
  ScanLine line;
  double begin_m = 0.0;     ///< First and last antenna position along the line,
  double end_m = 0.0;       ///< from its middle [m].
  double wavenumber = 0.0;  ///< One-way, of the middle channel [rad/m].
  double up_m = 0.0;        ///< Height of the tag above the antenna [m].
  Eigen::ArrayXd along_m;   ///< Antenna positions along the line, from its middle, ascending [m].
  Eigen::ArrayXcd field;    ///< Field at these positions, with norm 1 over all.
  double samples = 0.0;     ///< Maximum number of independent samples.
};

/// Longer scans see too many reflections for a single second path [m].
inline constexpr double kLongestScan = 3.0;

/// Field from the antenna that moved and has the most reads; its path must be straight. Reads
/// within λ/20 along the path share one position. Each channel has an offset, chosen so that
/// channels agree best. The phase is unwrapped along the positions; of several sections without
/// gaps longer than λ/4, the one with the most positions is used.
ScanField scan_field(const LocalizationProblem& problem, const std::string& tag,
                     const SamplesOfTag& samples);

}  // namespace tagfield
