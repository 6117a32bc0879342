// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/height_model.h"

#include <algorithm>

namespace tagfield {
namespace {

/// Antennas at heights that differ by less than this are at one height [m].
constexpr double kLevel = 0.01;
/// Number of planes searched if the height is unknown.
constexpr int kPlanes = 4;
constexpr double kPlanesApart = 0.7;  ///< [m]

}  // namespace

HeightModel estimated_height(HeightSide side, const TagPhases& phases) {
  const double sign = side == HeightSide::kAbove ? 1.0 : -1.0;
  if (phases.size() == 0) return {HeightModel::Kind::kLevel, 0.0, sign};
  const bool is_level = phases.z.maxCoeff() - phases.z.minCoeff() < kLevel;
  return {is_level ? HeightModel::Kind::kLevel : HeightModel::Kind::kFree, phases.z.mean(), sign};
}

HeightModel height_model(const LocalizationProblem& problem, const std::string& tag,
                         const TagPhases& phases) {
  const auto side = side_to_estimate(problem, tag);
  if (side) return estimated_height(*side, phases);
  return {HeightModel::Kind::kKnown, plane_height(problem, tag), 1.0};
}

std::vector<double> heights_to_search(const HeightModel& height) {
  if (height.kind == HeightModel::Kind::kKnown) return {height.z};
  std::vector<double> heights;
  heights.reserve(kPlanes);
  for (int plane = 0; plane < kPlanes; ++plane) {
    heights.push_back(height.z + height.side * kPlanesApart * plane);
  }
  return heights;
}

PositionVector to_unknowns(const HeightModel& height, const Eigen::Vector3d& p_WT) {
  const double up = p_WT.z() - height.z;
  switch (height.kind) {
    case HeightModel::Kind::kKnown:
      return {p_WT.x(), p_WT.y(), 0.0};
    case HeightModel::Kind::kLevel:
      return {p_WT.x(), p_WT.y(), up * up};
    case HeightModel::Kind::kFree:
      return {p_WT.x(), p_WT.y(), p_WT.z()};
  }
  return p_WT;
}

Eigen::Vector3d to_position(const HeightModel& height, const PositionVector& unknowns) {
  double z = height.z;
  if (height.kind == HeightModel::Kind::kLevel) {
    z += height.side * std::sqrt(std::max(unknowns[2], 0.0));
  }
  if (height.kind == HeightModel::Kind::kFree) z = unknowns[2];
  return {unknowns[0], unknowns[1], z};
}

Eigen::Matrix3d place_jacobian(const HeightModel& height, const PositionVector& unknowns,
                               double variance_q) {
  Eigen::Matrix3d J = Eigen::Matrix3d::Identity();
  if (height.kind == HeightModel::Kind::kKnown) J(2, 2) = 0.0;
  if (height.kind == HeightModel::Kind::kLevel) {
    // dz/dq = 1/(2|z − z_a|).
    const double scale = std::max(unknowns[2], std::sqrt(std::max(variance_q, 0.0)));
    J(2, 2) = height.side / (2.0 * std::sqrt(std::max(scale, 1e-6)));
  }
  return J;
}

Eigen::Matrix3d to_position_covariance(const HeightModel& height, const PositionVector& unknowns,
                                       const Eigen::Matrix3d& covariance) {
  const Eigen::Matrix3d J = place_jacobian(height, unknowns, covariance(2, 2));
  return J * covariance * J.transpose();
}

}  // namespace tagfield
