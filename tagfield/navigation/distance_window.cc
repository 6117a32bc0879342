// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/distance_window.h"

#include <algorithm>
#include <cmath>

#include "tagfield/navigation/near_distances.h"

namespace tagfield {

DistanceWindow::DistanceWindow(const OccupancyGrid& map,
                               const std::vector<Eigen::Vector2d>& points_M,
                               const Eigen::Vector2d& centre_M, double half_m, double max_m) {
  const Eigen::Vector2i low = map.cell_of(centre_M - Eigen::Vector2d(half_m, half_m));
  window_.resolution_m = map.resolution_m;
  window_.width = static_cast<int>(std::ceil(2.0 * half_m / map.resolution_m)) + 1;
  window_.height = window_.width;
  window_.origin = map.origin + map.resolution_m * low.cast<double>();
  std::vector<std::uint8_t> sources(static_cast<std::size_t>(window_.width) *
                                    static_cast<std::size_t>(window_.height));
  // The part of the window that is on the map.
  const Eigen::Vector2i begin = (-low).cwiseMax(0);
  const int end_x = std::min(window_.width, map.width - low.x());
  const int end_y = std::min(window_.height, map.height - low.y());
  for (int y = begin.y(); y < end_y; ++y) {
    for (int x = begin.x(); x < end_x; ++x) {
      const std::int8_t cell = map.cells[map.index(low.x() + x, low.y() + y)];
      sources[window_.index(x, y)] = is_occupied(cell) ? 1 : 0;
    }
  }
  for (const Eigen::Vector2d& point : points_M) {
    const Eigen::Vector2i cell = window_.cell_of(point);
    if (window_.contains(cell.x(), cell.y())) sources[window_.index(cell.x(), cell.y())] = 1;
  }
  distances_ = near_distances(sources, window_.width, cells_for(max_m, window_.resolution_m));
}

double DistanceWindow::at(const Eigen::Vector2d& p_M) const {
  const Eigen::Vector2d place =
      (p_M - window_.origin) / window_.resolution_m - Eigen::Vector2d(0.5, 0.5);
  if (!(place.minCoeff() >= 0.0) || !(place.x() < window_.width - 1) ||
      !(place.y() < window_.height - 1)) {
    return 0.0;
  }
  const int x = static_cast<int>(place.x());
  const int y = static_cast<int>(place.y());
  const double u = place.x() - x;
  const double v = place.y() - y;
  const auto d = [&](int i, int j) { return static_cast<double>(distances_[window_.index(i, j)]); };
  return window_.resolution_m * ((1.0 - v) * ((1.0 - u) * d(x, y) + u * d(x + 1, y)) +
                                 v * ((1.0 - u) * d(x, y + 1) + u * d(x + 1, y + 1)));
}

}  // namespace tagfield
