// SPDX-License-Identifier: Apache-2.0
/// @file
/// A tag's place as unknowns of a fit, with a height that is known or estimated.
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <string>
#include <vector>

#include "tagfield/localization/tag_phases.h"

namespace tagfield {

/// What is known of the tag's height, and how it is estimated where it is not.
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

/// Of a tag on that side of the antennas, at a height that is to be estimated.
HeightModel estimated_height(HeightSide side, const TagPhases& phases);

/// For these samples of the tag.
HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const TagPhases& phases);

/// Heights at which a search looks [m]: the known one, or four that are 0.7 m apart.
std::vector<double> heights_to_search(const HeightModel& height);

/// Unknowns of a place: x, y and, where it is estimated, q or z; else the third is 0.
using PlaceVector = Eigen::Vector3d;

PlaceVector to_unknowns(const HeightModel& height, const Eigen::Vector3d& p_WT);
Eigen::Vector3d to_place(const HeightModel& height, const PlaceVector& unknowns);

/// ∂place/∂unknowns, diagonal. Where q is near 0 its deviation, of variance `variance_q`, is the
/// scale.
Eigen::Matrix3d place_jacobian(const HeightModel& height, const PlaceVector& unknowns,
                               double variance_q);

/// Covariance of the place from that of the unknowns (the delta method).
Eigen::Matrix3d to_place_covariance(const HeightModel& height, const PlaceVector& unknowns,
                                    const Eigen::Matrix3d& covariance);

/// A range and its derivative by the unknowns.
struct Range {
  double r = 0.0;
  PlaceVector gradient;
};

/// From an antenna at (x, y, z), in one call each for speed.
inline Range range_to(const HeightModel& height, const PlaceVector& unknowns, double x, double y,
                      double z) {
  const double dx = unknowns[0] - x;
  const double dy = unknowns[1] - y;
  double up = height.z - z;
  if (height.kind == HeightModel::Kind::kFree) up = unknowns[2] - z;
  const double square = height.kind == HeightModel::Kind::kLevel ? unknowns[2] : up * up;
  // Nearer than 1 cm to the antenna no direction is told.
  const double r = std::sqrt(std::max(dx * dx + dy * dy + square, 1e-4));
  double third = 0.0;
  if (height.kind == HeightModel::Kind::kLevel) third = 0.5 / r;
  if (height.kind == HeightModel::Kind::kFree) third = up / r;
  return {r, {dx / r, dy / r, third}};
}

}  // namespace tagfield
