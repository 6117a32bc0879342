// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/internal/cell_marks.h"

#include <cmath>
#include <cstddef>
#include <limits>

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

}  // namespace

CellMarks::CellMarks(const Eigen::Vector2i& low, const Eigen::Vector2i& high)
    : x0(low.x()),
      y0(low.y()),
      width(high.x() - low.x() + 1),
      height(high.y() - low.y() + 1),
      marked(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0) {}

void CellMarks::mark_ray(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double last) {
  Walk x = walk_along(from.x(), to.x());
  Walk y = walk_along(from.y(), to.y());
  char* cell = marked.data() + place(x.cell, y.cell);
  const std::ptrdiff_t step_x = x.step;
  const std::ptrdiff_t step_y = y.step * static_cast<std::ptrdiff_t>(width);
  for (double entered = 0.0; entered < last;) {
    *cell = 1;
    // Which border comes first is practically random, so avoid a branch.
    const bool along_x = x.next < y.next;
    entered = along_x ? x.next : y.next;
    cell += along_x ? step_x : step_y;
    x.next += along_x ? x.share : 0.0;
    y.next += along_x ? 0.0 : y.share;
  }
}

}  // namespace tagfield
