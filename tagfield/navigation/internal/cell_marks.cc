// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/internal/cell_marks.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "tagfield/base/lanes.h"

namespace tagfield {
namespace {

/// Traversal of the cells by a ray along one axis.
struct Walk {
  int cell = 0;
  int step = 0;
  double next = 0.0;   ///< Fraction of the ray at which it enters the next cell.
  double share = 0.0;  ///< Fraction of the ray for a whole cell.
};

Walk walk_along(double from, double to) {
  Walk walk;
  walk.cell = static_cast<int>(std::floor(from));
  const double way = to - from;
  walk.step = way > 0.0 ? 1 : -1;
  if (way == 0.0) {
    walk.next = walk.share = std::numeric_limits<double>::infinity();
    return walk;
  }
  walk.share = 1.0 / std::abs(way);
  const double border = way > 0.0 ? walk.cell + 1.0 : static_cast<double>(walk.cell);
  walk.next = (border - from) / way;
  return walk;
}

/// Rays that advance together, one per lane: which border comes first is practically random, and
/// branches on it would be mispredicted.
constexpr std::size_t kLanes = 8;
using Doubles [[gnu::vector_size(kLanes * sizeof(double))]] = double;
using Integers [[gnu::vector_size(kLanes * sizeof(double))]] = std::int64_t;
struct WalkLanes {
  Doubles next_x{};
  Doubles next_y{};
  Doubles share_x{};
  Doubles share_y{};
  Doubles last{};
  Integers step_x{};
  Integers step_y{};
  Integers first{};  ///< Where rays wait that have ended: in a cell that is marked.
};

/// Marks each ray's cells until all have ended.
inline void mark_all(const WalkLanes& walks, char* marked) {
  Doubles x = walks.next_x;
  Doubles y = walks.next_y;
  Integers place = walks.first;
  for (bool is_going = true; is_going;) {
    for (std::size_t i = 0; i < kLanes; ++i) marked[place[i]] = 1;
    const Integers along_x = x < y;
    const Doubles entered = along_x ? x : y;
    const Integers going = entered < walks.last;
    const Integers beyond = place + (along_x ? walks.step_x : walks.step_y);
    place = going ? beyond : walks.first;
    x = along_x ? x + walks.share_x : x;
    y = along_x ? y : y + walks.share_y;
    std::int64_t any = 0;
    for (std::size_t i = 0; i < kLanes; ++i) any |= going[i];
    is_going = any != 0;
  }
}

}  // namespace

CellMarks::CellMarks(const Eigen::Vector2i& low, const Eigen::Vector2i& high)
    : x0(low.x()),
      y0(low.y()),
      width(high.x() - low.x() + 1),
      height(high.y() - low.y() + 1),
      marked(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

void CellMarks::mark_rays(const Eigen::Vector2d& from, std::span<const Ray> rays) {
  for (std::size_t begin = 0; begin < rays.size(); begin += kLanes) {
    const auto some = rays.subspan(begin, std::min(kLanes, rays.size() - begin));
    WalkLanes walks;
    for (std::size_t i = 0; i < kLanes; ++i) {
      // Missing rays repeat the last one.
      const Ray& ray = some[std::min(i, some.size() - 1)];
      const Walk x = walk_along(from.x(), ray.to.x());
      const Walk y = walk_along(from.y(), ray.to.y());
      walks.next_x[i] = x.next;
      walks.next_y[i] = y.next;
      walks.share_x[i] = x.share;
      walks.share_y[i] = y.share;
      walks.last[i] = ray.last;
      walks.step_x[i] = x.step;
      walks.step_y[i] = y.step * std::int64_t{width};
      walks.first[i] = static_cast<std::int64_t>(place(x.cell, y.cell));
    }
    in_lanes(instruction_sets().back(), [&] { mark_all(walks, marked.data()); });
  }
}

}  // namespace tagfield
