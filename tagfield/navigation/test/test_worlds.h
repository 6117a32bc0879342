// SPDX-License-Identifier: Apache-2.0
/// @file
/// Small maps and worlds for tests.
#pragma once

#include <string>
#include <vector>

#include "tagfield/map/true_map.h"
#include "tagfield/navigation/test/drive_simulation.h"

namespace tagfield::testing {

/// Mounting pose of a P3-AT's laser.
inline const RigidTransform kLaser = from_translation({0.15, 0.0, 0.31});

/// A map from rows of text, the last row at y = 0: '#' occupied, '?' unknown, everything else free.
inline OccupancyGrid grid_of(const std::vector<std::string>& rows, double resolution_m = 0.05) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width = static_cast<int>(rows.front().size());
  grid.height = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char c : *row) {
      grid.cells.push_back(c == '#'   ? std::int8_t{100}
                           : c == '?' ? std::int8_t{-1}
                                      : std::int8_t{0});
    }
  }
  return grid;
}

/// A free map of `width_m` by `height_m` surrounded by walls one cell thick, its corner at the
/// origin.
inline OccupancyGrid room_of(double width_m, double height_m, double resolution_m = 0.05) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width = static_cast<int>(std::lround(width_m / resolution_m));
  grid.height = static_cast<int>(std::lround(height_m / resolution_m));
  grid.cells.assign(static_cast<std::size_t>(grid.width) * static_cast<std::size_t>(grid.height),
                    0);
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const bool is_wall = x == 0 || y == 0 || x == grid.width - 1 || y == grid.height - 1;
      if (is_wall) grid.cells[grid.index(x, y)] = 100;
    }
  }
  return grid;
}

/// Sets the cells in a rectangle [m] to `value`.
inline void paint(OccupancyGrid& grid, const Eigen::Vector2d& low, const Eigen::Vector2d& high,
                  std::int8_t value) {
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const Eigen::Vector2d p = grid.centre_of(x, y);
      if ((p - low).minCoeff() >= 0.0 && (high - p).minCoeff() >= 0.0) {
        grid.cells[grid.index(x, y)] = value;
      }
    }
  }
}

/// A world of upright boxes to drive in.
struct BoxWorld {
  Scene scene;
  RayScene rays;
  Edges edges;
  OccupancyGrid map;

  /// Rectangles by their low and high corners; the map is what can be reached from `start`.
  BoxWorld(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& boxes,
           const Eigen::Vector2d& start)
      : scene(scene_of(boxes)),
        rays(scene),
        edges(scene, 0.02, 0.36),
        map(true_map(scene, 0.31, start, 0.05)) {}

  static Scene scene_of(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& boxes) {
    Scene scene;
    for (const auto& [low, high] : boxes) {
      const Eigen::Vector2d size = high - low;
      const Eigen::Vector2d centre = 0.5 * (low + high);
      scene.collisions.push_back(
          {"box", Box{{size.x(), size.y(), 2.0}}, from_translation({centre.x(), centre.y(), 1.0})});
    }
    return scene;
  }
};

/// Walls around the floor from `low` to `high`.
inline std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>> walls(const Eigen::Vector2d& low,
                                                                      const Eigen::Vector2d& high) {
  const Eigen::Vector2d thick(0.2, 0.2);
  return {{low - thick, {high.x() + 0.2, low.y()}},
          {{low.x() - 0.2, high.y()}, high + thick},
          {low - thick, {low.x(), high.y() + 0.2}},
          {{high.x(), low.y() - 0.2}, high + thick}};
}

/// A simulation in `world` from `pose`.
inline DriveSimulation simulation_in(const BoxWorld& world, const PlanarPose& pose) {
  DriveSimulation simulation;
  simulation.world = &world.rays;
  simulation.edges = &world.edges;
  simulation.pose = pose;
  return simulation;
}

}  // namespace tagfield::testing
