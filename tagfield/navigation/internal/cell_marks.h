// SPDX-License-Identifier: Apache-2.0
/// @file
/// Marks of the cells that the beams of one scan pass through.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

namespace tagfield {

/// Cells (x0, y0) to (x0 + width − 1, y0 + height − 1) in row-major order; 0 where no ray has
/// passed.
struct CellMarks {
  CellMarks(const Eigen::Vector2i& low, const Eigen::Vector2i& high);

  int x0, y0, width, height;
  std::vector<char> marked;

  /// A ray in units of cells; it counts before the fraction `last` ≤ 1 of its length.
  struct Ray {
    Eigen::Vector2d to;
    double last = 1.0;
  };

  /// Marks the cells that rays from `from` enter (Amanatides and Woo, 1987). All ends must lie in
  /// cells whose neighbours are all among these, since rounding may lead one cell too far.
  void mark_rays(const Eigen::Vector2d& from, std::span<const Ray> rays);

  /// Row y, beginning with cell (x0, y).
  [[nodiscard]] const char* row(int y) const { return marked.data() + place(x0, y); }

 private:
  [[nodiscard]] std::size_t place(int x, int y) const {
    return static_cast<std::size_t>(y - y0) * static_cast<std::size_t>(width) +
           static_cast<std::size_t>(x - x0);
  }
};

}  // namespace tagfield
