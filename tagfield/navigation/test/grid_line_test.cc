// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/grid_line.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <set>
#include <utility>

namespace tagfield {
namespace {

OccupancyGrid grid() {
  OccupancyGrid result;
  result.resolution_m = 0.1;
  result.width = 100;
  result.height = 100;
  result.origin = {-5.0, -5.0};
  result.cells.assign(10'000, 0);
  return result;
}

TEST(GridLine, VisitsARowInOrder) {
  std::vector<int> columns;
  double length = 0.0;
  EXPECT_TRUE(along_line(grid(), {0.02, 0.05}, {0.38, 0.05}, [&](int x, int y, double length_m) {
    EXPECT_EQ(y, 50);
    columns.push_back(x);
    length += length_m;
    return true;
  }));
  EXPECT_EQ(columns, (std::vector<int>{50, 51, 52, 53}));
  EXPECT_NEAR(length, 0.36, 1e-12);
}

TEST(GridLine, EndsWhereItIsStopped) {
  int count = 0;
  EXPECT_FALSE(
      along_line(grid(), {0.0, 0.0}, {3.0, 1.0}, [&](int, int, double) { return ++count < 4; }));
  EXPECT_EQ(count, 4);
}

TEST(GridLine, APointIsOneCell) {
  int count = 0;
  along_line(grid(), {0.05, 0.05}, {0.05, 0.05}, [&](int, int, double length_m) {
    EXPECT_EQ(length_m, 0.0);
    return ++count > 0;
  });
  EXPECT_EQ(count, 1);
}

RC_GTEST_PROP(GridLineProperties, VisitsTheCellsOfAllItsPoints, ()) {
  const auto draw = [] { return *rc::gen::inRange(-60'000, 60'000) * 1.0001e-4; };
  const Eigen::Vector2d a(draw(), draw());
  const Eigen::Vector2d b(draw(), draw());
  const OccupancyGrid cells = grid();
  std::set<std::pair<int, int>> visited;
  double length = 0.0;
  along_line(cells, a, b, [&](int x, int y, double length_m) {
    RC_ASSERT(length_m >= 0.0);
    length += length_m;
    visited.emplace(x, y);
    return true;
  });
  RC_ASSERT(std::abs(length - (b - a).norm()) < 1e-9);
  for (int i = 0; i <= 5000; ++i) {
    const Eigen::Vector2d p = a + (b - a) * (i / 5000.0);
    const Eigen::Vector2d inside = (p - cells.origin) / 0.1;
    // Points on a border belong to either side.
    const Eigen::Vector2d to_border = (inside - inside.array().round().matrix()).cwiseAbs();
    if (to_border.minCoeff() < 1e-6) continue;
    const Eigen::Vector2i cell = cells.cell_of(p);
    RC_ASSERT(visited.count({cell.x(), cell.y()}) == 1U);
  }
}

}  // namespace
}  // namespace tagfield
