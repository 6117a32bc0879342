// SPDX-License-Identifier: Apache-2.0
/// @file
/// The cells of a grid that a straight line passes through.
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// Calls `visit(x, y, length_m)` in order for each cell that the line from `a` to `b` passes
/// through, with the length of the line within that cell (Amanatides and Woo, 1987), until `visit`
/// returns false. Where the line goes exactly through a corner, it visits one of the two cells
/// beside it. Returns whether all cells were visited. Both points must be within 1e9 cells of the
/// origin.
template <typename Visit>
bool along_line(const OccupancyGrid& grid, const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                Visit visit) {
  constexpr double kNever = std::numeric_limits<double>::infinity();
  const Eigen::Vector2d way = b - a;
  const double length = way.norm();
  Eigen::Vector2i cell = grid.cell_of(a);
  const Eigen::Vector2i last = grid.cell_of(b);
  Eigen::Vector2i step = Eigen::Vector2i::Zero();
  Eigen::Vector2d next(kNever, kNever);   // Fraction of the line at which the next cell begins.
  Eigen::Vector2d every(kNever, kNever);  // Fraction of the line from one to the next.
  for (int i = 0; i < 2; ++i) {
    if (cell[i] == last[i]) continue;
    step[i] = last[i] > cell[i] ? 1 : -1;
    const double border = grid.origin[i] + (cell[i] + (step[i] > 0 ? 1 : 0)) * grid.resolution_m;
    next[i] = (border - a[i]) / way[i];
    every[i] = grid.resolution_m / std::abs(way[i]);
  }
  const int steps = (last - cell).cwiseAbs().sum();
  double here = 0.0;
  for (int i = 0; i < steps; ++i) {
    const int axis = cell.y() == last.y() || (cell.x() != last.x() && next.x() < next.y()) ? 0 : 1;
    const double there = std::clamp(next[axis], here, 1.0);
    if (!visit(cell.x(), cell.y(), (there - here) * length)) return false;
    here = there;
    cell[axis] += step[axis];
    next[axis] += every[axis];
  }
  return visit(cell.x(), cell.y(), (1.0 - here) * length);
}

}  // namespace tagfield
