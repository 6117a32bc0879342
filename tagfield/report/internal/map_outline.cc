// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/map_outline.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <vector>

namespace tagfield {
namespace {

/// The borders between cells that belong and cells that don't, each traversed with the former on
/// its left.
struct Borders {
  int width = 0;  ///< Number of corners along x.
  /// For each corner, one bit per direction in which a border leaves it.
  std::vector<std::uint8_t> leaving;

  [[nodiscard]] std::uint8_t& at(const Eigen::Vector2i& corner) {
    return leaving[static_cast<std::size_t>(corner.y()) * static_cast<std::size_t>(width) +
                   static_cast<std::size_t>(corner.x())];
  }
};

/// Right, up, left, down.
const std::array<Eigen::Vector2i, 4> kDirections = {Eigen::Vector2i(1, 0), Eigen::Vector2i(0, 1),
                                                    Eigen::Vector2i(-1, 0), Eigen::Vector2i(0, -1)};
/// Corner of a cell at which its border in each direction begins.
const std::array<Eigen::Vector2i, 4> kCorners = {Eigen::Vector2i(0, 0), Eigen::Vector2i(1, 0),
                                                 Eigen::Vector2i(1, 1), Eigen::Vector2i(0, 1)};

Borders borders_of(const OccupancyGrid& grid, const std::function<bool(std::int8_t)>& belongs) {
  Borders borders{grid.width + 1, {}};
  borders.leaving.resize(static_cast<std::size_t>(grid.width + 1) *
                         static_cast<std::size_t>(grid.height + 1));
  const auto is_in = [&](int x, int y) { return grid.contains(x, y) && belongs(grid.at(x, y)); };
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      if (!is_in(x, y)) continue;
      for (std::size_t i = 0; i < 4; ++i) {
        const Eigen::Vector2i& outwards = kDirections[(i + 3) % 4];
        if (is_in(x + outwards.x(), y + outwards.y())) continue;
        borders.at(Eigen::Vector2i(x, y) + kCorners[i]) |= static_cast<std::uint8_t>(1U << i);
      }
    }
  }
  return borders;
}

/// Removes a border that leaves the corner and returns its direction.
std::size_t take_border(std::uint8_t& leaving) {
  std::size_t direction = 0;
  while ((leaving & (1U << direction)) == 0) ++direction;
  leaving = static_cast<std::uint8_t>(leaving & ~(1U << direction));
  return direction;
}

void append_run(std::string& data, std::size_t direction, int length) {
  if (length == 0) return;
  const bool along_x = direction % 2 == 0;
  data += fmt::format("{}{}", along_x ? 'h' : 'v', direction < 2 ? length : -length);
}

/// Follows borders from a corner until back at it; each corner has as many incoming as outgoing
/// borders.
void append_ring(std::string& data, Borders& borders, Eigen::Vector2i corner) {
  data += fmt::format("M{},{}", corner.x(), corner.y());
  std::size_t direction = 0;
  int length = 0;
  while (borders.at(corner) != 0) {
    const std::size_t next = take_border(borders.at(corner));
    if (next != direction) {
      append_run(data, direction, length);
      length = 0;
    }
    direction = next;
    corner += kDirections[direction];
    ++length;
  }
  append_run(data, direction, length);
  data += 'z';
}

std::int8_t merged(const OccupancyGrid& grid, int x, int y, int step) {
  std::int8_t result = -1;
  for (int v = y; v < std::min(y + step, grid.height); ++v) {
    for (int u = x; u < std::min(x + step, grid.width); ++u) {
      if (is_occupied(grid.at(u, v))) return 100;
      if (is_free(grid.at(u, v))) result = 0;
    }
  }
  return result;
}

}  // namespace

std::string cell_outline(const OccupancyGrid& grid,
                         const std::function<bool(std::int8_t)>& belongs) {
  Borders borders = borders_of(grid, belongs);
  std::string data;
  for (int y = 0; y <= grid.height; ++y) {
    for (int x = 0; x <= grid.width; ++x) {
      if (borders.at({x, y}) != 0) append_ring(data, borders, {x, y});
    }
  }
  return data;
}

OccupancyGrid coarsened(const OccupancyGrid& grid, int step) {
  OccupancyGrid coarse;
  coarse.resolution_m = step * grid.resolution_m;
  coarse.width = (grid.width + step - 1) / step;
  coarse.height = (grid.height + step - 1) / step;
  coarse.origin = grid.origin;
  for (int y = 0; y < coarse.height; ++y) {
    for (int x = 0; x < coarse.width; ++x) {
      coarse.cells.push_back(merged(grid, step * x, step * y, step));
    }
  }
  return coarse;
}

}  // namespace tagfield
