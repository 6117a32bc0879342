// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot_clearance.h"

#include <algorithm>
#include <cmath>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/map/top_view.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/keep_out.h"

namespace tagfield {
namespace {

constexpr double kResolution = 0.02;
/// Nothing farther than this from the origin is of interest: a robot's map spans about 100 m.
constexpr double kFarthest = 200.0;
/// Margin of the grid around solids.
constexpr double kBeyond = 2.0;

OccupancyGrid empty_grid_around(const std::vector<Silhouette>& solids) {
  OccupancyGrid grid;
  grid.resolution_m = kResolution;
  Eigen::Vector2d low = Eigen::Vector2d::Constant(1e9);
  Eigen::Vector2d high = -low;
  for (const Silhouette& solid : solids) {
    for (const Polygon& ring : solid.rings) {
      for (const Eigen::Vector2d& p : ring) {
        low = low.cwiseMin(p);
        high = high.cwiseMax(p);
      }
    }
  }
  if (low.x() > high.x()) low = high = Eigen::Vector2d::Zero();
  low = low.cwiseMax(-kFarthest) - Eigen::Vector2d::Constant(kBeyond);
  high = high.cwiseMin(kFarthest) + Eigen::Vector2d::Constant(kBeyond);
  grid.origin = low;
  grid.width = static_cast<int>(std::ceil((high.x() - low.x()) / kResolution));
  grid.height = static_cast<int>(std::ceil((high.y() - low.y()) / kResolution));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                    0);
  return grid;
}

Eigen::Vector2d half_of(const RobotOutline& outline) {
  return {outline.length_m / 2.0, outline.width_m / 2.0};
}

/// Distance to a point in the robot's frame; 0 inside.
double distance_to_point(const RobotOutline& outline, const Eigen::Vector2d& p_R) {
  return (p_R.cwiseAbs() - half_of(outline)).cwiseMax(0.0).norm();
}

double point_to_line(const Eigen::Vector2d& p, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  const Eigen::Vector2d way = b - a;
  const double length = way.squaredNorm();
  const double share = length > 0.0 ? std::clamp((p - a).dot(way) / length, 0.0, 1.0) : 0.0;
  return (a + share * way - p).norm();
}

/// Whether the line from a to b passes through the rectangle centred on the origin (Liang and
/// Barsky).
bool crosses(const Eigen::Vector2d& half, const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  double from = 0.0;
  double to = 1.0;
  for (int i = 0; i < 2; ++i) {
    const double way = b[i] - a[i];
    if (way == 0.0) {
      if (std::abs(a[i]) > half[i]) return false;
      continue;
    }
    const double one = (-half[i] - a[i]) / way;
    const double other = (half[i] - a[i]) / way;
    from = std::max(from, std::min(one, other));
    to = std::min(to, std::max(one, other));
  }
  return from <= to;
}

/// Distance to a box on the floor, whose frame is B.
double distance_to_box(const RobotOutline& outline, const PlanarPose& pose_W,
                       const Rectangle& box) {
  const PlanarPose q_WB{box.centre.x(), box.centre.y(), box.yaw};
  const PlanarPose q_BR = between(q_WB, pose_W);
  // The robot may be inside the box without touching an edge.
  if (((position_of(q_BR).cwiseAbs() - box.size / 2.0).array() <= 0.0).all()) return 0.0;
  const PlanarPose q_RB = between(pose_W, q_WB);
  const auto corner = [&](double x, double y) {
    return transformed(q_RB, {x * box.size.x() / 2.0, y * box.size.y() / 2.0});
  };
  const Eigen::Vector2d corners[] = {corner(1, 1), corner(-1, 1), corner(-1, -1), corner(1, -1)};
  double least = RobotClearance::kMost;
  for (int i = 0; i < 4; ++i) {
    least = std::min(least, distance_to_line(outline, corners[i], corners[(i + 1) % 4]));
  }
  return least;
}

}  // namespace

double distance_to_line(const RobotOutline& outline, const Eigen::Vector2d& a,
                        const Eigen::Vector2d& b) {
  const Eigen::Vector2d half = half_of(outline);
  if (crosses(half, a, b)) return 0.0;
  double least = std::min(distance_to_point(outline, a), distance_to_point(outline, b));
  for (const double x : {-half.x(), half.x()}) {
    for (const double y : {-half.y(), half.y()}) {
      least = std::min(least, point_to_line({x, y}, a, b));
    }
  }
  return least;
}

RobotClearance::RobotClearance(const Scene& scene, const RobotOutline& outline)
    : outline_(outline), reach_m_(kMost + half_of(outline).norm()) {
  const std::vector<Silhouette> solids =
      top_view(scene, kRolledOver, outline.height_m, /*margin=*/1e-3);
  for (const Silhouette& solid : solids) {
    for (const Polygon& ring : solid.rings) {
      for (std::size_t i = 0; i < ring.size(); ++i) {
        add_edge({ring[i], ring[(i + 1) % ring.size()]});
      }
    }
  }
  grid_ = with_keep_out(empty_grid_around(solids), solids, {});
  std::vector<bool> solid;
  solid.reserve(grid_.cells.size());
  for (const std::int8_t cell : grid_.cells) solid.push_back(is_occupied(cell));
  distances_ = distance_field(grid_, solid, kMaxRoom);
}

void RobotClearance::add_edge(const Edge& edge) {
  const auto square = [](double x) {
    return static_cast<int>(std::floor(std::clamp(x, -kFarthest, kFarthest)));
  };
  const Eigen::Vector2d low = edge.first.cwiseMin(edge.second).array() - reach_m_;
  const Eigen::Vector2d high = edge.first.cwiseMax(edge.second).array() + reach_m_;
  for (int y = square(low.y()); y <= square(high.y()); ++y) {
    for (int x = square(low.x()); x <= square(high.x()); ++x) edges_[{x, y}].push_back(edge);
  }
}

double RobotClearance::room_at(const Eigen::Vector2d& p_W) const {
  const Eigen::Vector2i cell = grid_.cell_of(p_W);
  if (!grid_.contains(cell.x(), cell.y())) return kBeyond;
  // From centre to centre: each may be off by half a diagonal.
  const double between_centres = distances_[grid_.index(cell.x(), cell.y())];
  return std::max(between_centres - std::sqrt(2.0) * kResolution, 0.0);
}

double RobotClearance::distance_to_solids(const PlanarPose& pose_W) const {
  const auto found =
      edges_.find({static_cast<int>(std::floor(pose_W.x)), static_cast<int>(std::floor(pose_W.y))});
  if (found == edges_.end()) return kMost;
  double least = kMost;
  for (const auto& [a_W, b_W] : found->second) {
    if (point_to_line(position_of(pose_W), a_W, b_W) > reach_m_) continue;
    const PlanarPose a_R = between(pose_W, {a_W.x(), a_W.y(), 0.0});
    const PlanarPose b_R = between(pose_W, {b_W.x(), b_W.y(), 0.0});
    least = std::min(least, distance_to_line(outline_, position_of(a_R), position_of(b_R)));
  }
  return least;
}

double RobotClearance::distance(const PlanarPose& pose_W, const Obstacles& obstacles) const {
  double least = distance_to_solids(pose_W);
  for (const Disc& disc : obstacles.discs) {
    const PlanarPose centre_R = between(pose_W, {disc.centre.x(), disc.centre.y(), 0.0});
    least = std::min(least, distance_to_point(outline_, position_of(centre_R)) - disc.radius);
  }
  for (const Rectangle& box : obstacles.rectangles) {
    least = std::min(least, distance_to_box(outline_, pose_W, box));
  }
  return std::max(least, 0.0);
}

double RobotClearance::distance_between(const PlanarPose& one_W, const PlanarPose& other_W) const {
  const Rectangle other{position_of(other_W), 2.0 * half_of(outline_), other_W.yaw};
  return distance_to_box(outline_, one_W, other);
}

}  // namespace tagfield
