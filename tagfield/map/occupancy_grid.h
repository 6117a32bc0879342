// SPDX-License-Identifier: Apache-2.0
/// @file
/// Occupancy map of the floor: free, occupied and unknown cells.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

namespace tagfield {

/// Layout of nav_msgs/OccupancyGrid: row by row from the origin's corner, x first; from 0
/// (certainly free) to 100 (certainly occupied), -1 unknown. Axes are aligned with the map frame M.
struct OccupancyGrid {
  double resolution_m = 0.05;
  int width = 0;                                     ///< Cells along x.
  int height = 0;                                    ///< Cells along y.
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();  ///< Outer corner of cell (0, 0) [m].
  std::vector<std::int8_t> cells;                    ///< width·height

  [[nodiscard]] bool contains(int x, int y) const {
    return x >= 0 && y >= 0 && x < width && y < height;
  }
  [[nodiscard]] std::size_t index(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x);
  }
  /// -1 outside the map.
  [[nodiscard]] std::int8_t at(int x, int y) const {
    return contains(x, y) ? cells[index(x, y)] : std::int8_t{-1};
  }
  /// The cell that contains the point, which may be outside the map. A point beyond 1e9 cells or
  /// not finite gives a cell outside any map.
  [[nodiscard]] Eigen::Vector2i cell_of(const Eigen::Vector2d& p) const {
    return {whole((p.x() - origin.x()) / resolution_m), whole((p.y() - origin.y()) / resolution_m)};
  }
  [[nodiscard]] Eigen::Vector2d centre_of(int x, int y) const {
    return {origin.x() + (x + 0.5) * resolution_m, origin.y() + (y + 0.5) * resolution_m};
  }

 private:
  static int whole(double cells) {
    // In this order, NaN becomes 1e9, and no conversion overflows.
    return static_cast<int>(std::floor(std::max(-1e9, std::min(1e9, cells))));
  }
};

/// The map server's defaults: occupied from 65 %, free below 19.6 %.
inline constexpr int kOccupiedFrom = 65;
inline constexpr int kFreeBelow = 20;

inline bool is_occupied(std::int8_t cell) { return cell >= kOccupiedFrom; }
inline bool is_free(std::int8_t cell) { return cell >= 0 && cell < kFreeBelow; }

/// Distance from each cell's centre to the nearest centre of a cell for which `is_source` [m];
/// exact (Felzenszwalb and Huttenlocher, Distance Transforms of Sampled Functions, Theory of
/// Computing 8, 2012, here in integers). Clamped to `max_m`, which also applies if there is no
/// source. `is_source` and the result have the order and size of the grid's cells.
std::vector<float> distance_field(const OccupancyGrid& grid, const std::vector<bool>& is_source,
                                  double max_m);

}  // namespace tagfield
