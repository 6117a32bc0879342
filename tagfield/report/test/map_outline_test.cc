// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/map_outline.h"

#include <gtest/gtest.h>

#include <sstream>

namespace tagfield {
namespace {

/// A grid from rows, topmost first: '#' occupied, '.' free, '?' unknown.
OccupancyGrid grid_of(const std::vector<std::string>& rows) {
  OccupancyGrid grid;
  grid.width = static_cast<int>(rows.front().size());
  grid.height = static_cast<int>(rows.size());
  for (auto row = rows.rbegin(); row != rows.rend(); ++row) {
    for (const char cell : *row) {
      grid.cells.push_back(static_cast<std::int8_t>(cell == '#' ? 100 : cell == '.' ? 0 : -1));
    }
  }
  return grid;
}

struct Upright {
  int x = 0;
  int low = 0;
  int high = 0;
};

/// The vertical lines of path data consisting of M, h, v and z.
std::vector<Upright> uprights_of(const std::string& data) {
  std::vector<Upright> lines;
  std::istringstream stream(data);
  char command = 0;
  Eigen::Vector2i at(0, 0);
  while (stream >> command) {
    char comma = 0;
    int number = 0;
    if (command == 'M') stream >> at.x() >> comma >> at.y();
    if (command == 'h' && stream >> number) at.x() += number;
    if (command != 'v') continue;
    stream >> number;
    lines.push_back({at.x(), std::min(at.y(), at.y() + number), std::max(at.y(), at.y() + number)});
    at.y() += number;
  }
  return lines;
}

/// Whether the cell is inside by the even-odd rule.
bool is_filled(const std::vector<Upright>& lines, int x, int y) {
  int crossed = 0;
  for (const Upright& line : lines) crossed += line.x <= x && line.low <= y && y < line.high;
  return crossed % 2 == 1;
}

void expect_outline_fills_the_same(const OccupancyGrid& grid) {
  const auto lines = uprights_of(cell_outline(grid, is_occupied));
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      EXPECT_EQ(is_filled(lines, x, y), is_occupied(grid.at(x, y))) << x << ' ' << y;
    }
  }
}

TEST(CellOutline, OfNothingIsEmpty) {
  EXPECT_EQ(cell_outline(grid_of({"..", "??"}), is_occupied), "");
}

TEST(CellOutline, OfABlockIsOneRing) {
  EXPECT_EQ(cell_outline(grid_of({"....", ".##.", ".##.", ".##."}), is_occupied),
            "M1,0h2v3h-2v-3z");
}

TEST(CellOutline, FillsJustTheCells) {
  expect_outline_fills_the_same(grid_of({"#"}));
  expect_outline_fills_the_same(grid_of({"###", "#.#", "###"}));
  expect_outline_fills_the_same(grid_of({"#.#.", ".#.#", "#.#."}));
  expect_outline_fills_the_same(grid_of({"#####", "#...#", "#.#.#", "##..#", "#.###"}));
}

TEST(CellOutline, FillsJustTheCellsOfNoise) {
  OccupancyGrid grid;
  grid.width = 37;
  grid.height = 23;
  unsigned number = 1;
  for (int i = 0; i < grid.width * grid.height; ++i) {
    number = 1664525U * number + 1013904223U;
    grid.cells.push_back(static_cast<std::int8_t>((number >> 30U) == 0U ? 100 : 0));
  }
  expect_outline_fills_the_same(grid);
}

TEST(Coarsened, KeepsWallsBeforeFloor) {
  OccupancyGrid grid = grid_of({"?..??", "#..??", "?????"});
  grid.resolution_m = 0.1;
  grid.origin = {1.0, 2.0};
  const OccupancyGrid coarse = coarsened(grid, 2);
  EXPECT_EQ(coarse.width, 3);
  EXPECT_EQ(coarse.height, 2);
  EXPECT_DOUBLE_EQ(coarse.resolution_m, 0.2);
  EXPECT_EQ(coarse.origin, grid.origin);
  EXPECT_EQ(coarse.cells, (std::vector<std::int8_t>{100, 0, -1, 0, 0, -1}));
}

}  // namespace
}  // namespace tagfield
