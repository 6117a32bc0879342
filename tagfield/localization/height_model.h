// SPDX-License-Identifier: Apache-2.0
/// @file
/// A tag's position as the unknowns of a fit, with a known or estimated height.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// What is known of the tag's height, and how it is estimated otherwise.
struct HeightModel {
  enum class Kind {
    kKnown,  ///< z is `z`.
    kLevel,  ///< Antennas all at height `z`: q = (z_tag − z)² is estimated, in which ranges are
             ///< linear.
    kFree,   ///< z is estimated.
  };
  Kind kind = Kind::kKnown;
  double z = 0.0;     ///< [m]
  double side = 1.0;  ///< 1 above, −1 below.

  [[nodiscard]] int unknowns() const { return kind == Kind::kKnown ? 2 : 3; }
};

/// Model of a tag at a height to be estimated, on that side of the antennas.
HeightModel estimated_height(HeightSide side, const TagPhases& phases);

/// Model of the tag's height given its phases.
HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const TagPhases& phases);

/// Heights to be searched [m]: the known one, or four that are 0.7 m apart.
std::vector<double> heights_to_search(const HeightModel& height);

/// Unknowns of a position: x, y and q or z if the height is estimated; otherwise the third is 0.
using PositionVector = Eigen::Vector3d;

PositionVector to_unknowns(const HeightModel& height, const Eigen::Vector3d& p_WT);
Eigen::Vector3d to_position(const HeightModel& height, const PositionVector& unknowns);

/// ∂position/∂unknowns, diagonal. Where q is near 0, its standard deviation (the root of
/// `variance_q`) is used in its place.
Eigen::Matrix3d place_jacobian(const HeightModel& height, const PositionVector& unknowns,
                               double variance_q);

/// Covariance of the position from that of the unknowns (the delta method).
Eigen::Matrix3d to_position_covariance(const HeightModel& height, const PositionVector& unknowns,
                                       const Eigen::Matrix3d& covariance);

/// A range and its derivative with respect to the unknowns.
struct Range {
  double r = 0.0;
  PositionVector gradient;
};

/// Range from an antenna at (x, y, z). Value and gradient in one call, for speed.
inline Range range_to(const HeightModel& height, const PositionVector& unknowns, double x, double y,
                      double z) {
  const double dx = unknowns[0] - x;
  const double dy = unknowns[1] - y;
  double up = height.z - z;
  if (height.kind == HeightModel::Kind::kFree) up = unknowns[2] - z;
  const double square = height.kind == HeightModel::Kind::kLevel ? unknowns[2] : up * up;
  // Within 1 cm of the antenna the direction is undefined.
  const double r = std::sqrt(std::max(dx * dx + dy * dy + square, 1e-4));
  double third = 0.0;
  if (height.kind == HeightModel::Kind::kLevel) third = 0.5 / r;
  if (height.kind == HeightModel::Kind::kFree) third = up / r;
  return {r, {dx / r, dy / r, third}};
}

}  // namespace tagfield
