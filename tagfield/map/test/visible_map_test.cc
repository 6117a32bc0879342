// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/visible_map.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// '#' occupied, '.' free, ' ' unknown; the last line is row 0.
OccupancyGrid grid_of(const std::vector<std::string>& lines, double resolution_m) {
  OccupancyGrid grid;
  grid.resolution_m = resolution_m;
  grid.width = static_cast<int>(lines.front().size());
  grid.height = static_cast<int>(lines.size());
  for (auto line = lines.rbegin(); line != lines.rend(); ++line) {
    for (const char c : *line) {
      grid.cells.push_back(static_cast<std::int8_t>(c == '#' ? 100 : (c == '.' ? 0 : -1)));
    }
  }
  return grid;
}

std::string row(const OccupancyGrid& grid, int from_top) {
  std::string text;
  for (int x = 0; x < grid.width; ++x) {
    const int cell = grid.at(x, grid.height - 1 - from_top);
    text += cell == 100 ? '#' : (cell == 0 ? '.' : ' ');
  }
  return text;
}

TEST(VisibleMap, KeepsAllOfAnEmptyRoom) {
  const OccupancyGrid truth =
      grid_of({"#######", "#.....#", "#.....#", "#.....#", "#.....#", "#.....#", "#######"}, 0.4);
  EXPECT_EQ(visible_map(truth, {1.4, 1.4}, 0.5).cells, truth.cells);
}

TEST(VisibleMap, ForgetsTheNookThatNobodyLooksInto) {
  // The robot stays in the left room, as it is too wide for the gap; the bend of the passage behind
  // the gap is out of sight.
  const OccupancyGrid truth = grid_of({"###############",  //
                                       "#.......#.....#",  //
                                       "#.......#.###.#",  //
                                       "#.........#.#.#",  //
                                       "#.......#.###.#",  //
                                       "#.......#.....#",  //
                                       "###############"},
                                      0.4);
  const OccupancyGrid seen = visible_map(truth, {1.8, 1.4}, 0.7);
  EXPECT_EQ(row(seen, 3).substr(0, 11), "#.........#");
  EXPECT_EQ(row(seen, 3).substr(11), "    ");  // behind the visible wall
  EXPECT_EQ(seen.at(13, 1), -1);               // around the corner
  EXPECT_EQ(seen.at(13, 0), -1);               // and its wall
}

TEST(VisibleMap, AWiderRobotSeesLess) {
  // The shaft at the end can only be seen from within the corridor on the right.
  const OccupancyGrid truth = grid_of({"###########.#",  //
                                       "#....######.#",  //
                                       "#....######.#",  //
                                       "#...........#",  //
                                       "#....########",  //
                                       "#....########",  //
                                       "#############"},
                                      0.4);
  const OccupancyGrid slim = visible_map(truth, {1.0, 1.0}, 0.3);
  const OccupancyGrid wide = visible_map(truth, {1.0, 1.0}, 0.6);
  EXPECT_EQ(slim.at(11, 6), 0);
  EXPECT_EQ(wide.at(11, 6), -1);
  EXPECT_EQ(wide.at(8, 3), 0);
}

TEST(VisibleMap, RefusesAStartThatIsTooNarrow) {
  const OccupancyGrid truth = grid_of({"###", "#.#", "###"}, 0.4);
  EXPECT_THROW(visible_map(truth, {0.6, 0.6}, 0.5), Error);
  EXPECT_THROW(visible_map(truth, {5.0, 5.0}, 0.1), Error);
}

}  // namespace
}  // namespace tagfield
