#include "simulator/robot_clearance.h"

#include <algorithm>
#include <cmath>

#include "navigation/keep_out.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/world/top_view.h"

namespace tagfield {
namespace {

constexpr double kResolution = 0.02;
/// What a P3-AT's wheels roll over [m].
constexpr double kThreshold = 0.06;
constexpr double kMost = 2.0;
constexpr double kRimSpacing = 0.04;

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
  // Things far outside are no concern of a robot that drives by a map of some 100 m.
  low = low.cwiseMax(-200.0) - Eigen::Vector2d::Constant(kMost);
  high = high.cwiseMin(200.0) + Eigen::Vector2d::Constant(kMost);
  grid.origin = low;
  grid.width = static_cast<int>(std::ceil((high.x() - low.x()) / kResolution));
  grid.height = static_cast<int>(std::ceil((high.y() - low.y()) / kResolution));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                    0);
  return grid;
}

}  // namespace

RobotClearance::RobotClearance(const Scene& scene, const RobotOutline& outline)
    : outline_(outline) {
  const std::vector<Silhouette> solids =
      top_view(scene, kThreshold, outline.height_m, /*margin=*/1e-3);
  grid_ = with_keep_out(empty_grid_around(solids), solids, {});
  std::vector<bool> solid;
  solid.reserve(grid_.cells.size());
  for (const std::int8_t cell : grid_.cells) solid.push_back(is_occupied(cell));
  distances_ = distance_field(grid_, solid, kMost);
}

double RobotClearance::distance(const PlanarPose& pose_W, const Obstacles& obstacles) const {
  double least = kMost;
  const auto look = [&](double x, double y) {
    const Eigen::Vector2d p = transformed(pose_W, {x, y});
    const Eigen::Vector2i cell = grid_.cell_of(p);
    if (grid_.contains(cell.x(), cell.y())) {
      // From centre to centre: either may be half a diagonal off.
      const double between = distances_[grid_.index(cell.x(), cell.y())];
      least = std::min(least, between - std::sqrt(2.0) * kResolution);
    }
    least = std::min(least, distance_to_obstacles(obstacles, p));
  };
  const double l = outline_.length_m / 2.0;
  const double w = outline_.width_m / 2.0;
  const int along = static_cast<int>(std::ceil(2.0 * l / kRimSpacing));
  for (int i = 0; i <= along; ++i) {
    const double x = -l + 2.0 * l * i / along;
    look(x, w);
    look(x, -w);
    const double y = -w + 2.0 * w * i / along;
    look(l, y);
    look(-l, y);
  }
  return least;
}

}  // namespace tagfield
