// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/keep_out.h"

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/grid_line.h"

namespace tagfield {
namespace {

constexpr std::int8_t kKeptOutCell = 100;

void mark(OccupancyGrid& map, int x, int y) {
  if (map.contains(x, y)) map.cells[map.index(x, y)] = kKeptOutCell;
}

/// x coordinates at which the rings cross the line y = `y`, from left to right.
std::vector<double> crossings(const std::vector<Polygon>& rings, double y) {
  std::vector<double> found;
  for (const Polygon& ring : rings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      if ((a.y() > y) == (b.y() > y)) continue;
      found.push_back(a.x() + (y - a.y()) * (b.x() - a.x()) / (b.y() - a.y()));
    }
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Fills the cells whose centre lies inside the rings, by the even-odd rule.
void fill(OccupancyGrid& map, const std::vector<Polygon>& rings) {
  for (int y = 0; y < map.height; ++y) {
    const double line = map.centre_of(0, y).y();
    const std::vector<double> ends = crossings(rings, line);
    for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
      const int first = std::max(0, map.cell_of({ends[i], line}).x());
      const int last = std::min(map.width - 1, map.cell_of({ends[i + 1], line}).x());
      for (int x = first; x <= last; ++x) {
        const double centre = map.centre_of(x, y).x();
        if (centre >= ends[i] && centre <= ends[i + 1]) mark(map, x, y);
      }
    }
  }
}

void outline(OccupancyGrid& map, const Polygon& ring) {
  for (std::size_t i = 0; i < ring.size(); ++i) {
    along_line(map, ring[i], ring[(i + 1) % ring.size()], [&](int x, int y, double) {
      mark(map, x, y);
      return true;
    });
  }
}

}  // namespace

OccupancyGrid with_keep_out(const OccupancyGrid& map, const std::vector<Silhouette>& silhouettes_W,
                            const PlanarPose& q_MW) {
  OccupancyGrid marked = map;
  for (const Silhouette& silhouette : silhouettes_W) {
    std::vector<Polygon> rings_M;
    for (const Polygon& ring : silhouette.rings) {
      rings_M.emplace_back();
      for (const Eigen::Vector2d& p_W : ring) rings_M.back().push_back(transformed(q_MW, p_W));
      outline(marked, rings_M.back());
    }
    fill(marked, rings_M);
  }
  return marked;
}

}  // namespace tagfield
