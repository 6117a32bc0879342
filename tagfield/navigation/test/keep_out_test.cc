// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/keep_out.h"

#include <gtest/gtest.h>

#include "tagfield/navigation/test/test_worlds.h"

namespace tagfield {
namespace {

using testing::room_of;

int occupied(const OccupancyGrid& grid) {
  int count = 0;
  for (const std::int8_t cell : grid.cells) count += cell == 100 ? 1 : 0;
  return count;
}

TEST(KeepOut, MarksALowShelfThatTheLaserPassesAbove) {
  Scene scene;
  scene.collisions.push_back({"shelf", Box{{2.0, 1.0, 0.04}}, from_translation({5.0, 3.0, 0.15})});
  const OccupancyGrid map = room_of(10.0, 6.0);
  const OccupancyGrid marked = with_keep_out(map, top_view(scene, 0.02, 0.36, 0.0), {});
  EXPECT_EQ(marked.at(100, 60), 100);
  EXPECT_EQ(marked.at(81, 51), 100);
  EXPECT_EQ(marked.at(78, 60), 0);
  EXPECT_EQ(marked.at(100, 72), 0);
  // 40 by 20 cells, plus those that its outline touches.
  EXPECT_GE(occupied(marked) - occupied(map), 800);
  EXPECT_LE(occupied(marked) - occupied(map), 42 * 22);
}

TEST(KeepOut, PlacesTheWorldOnTheMap) {
  const Silhouette square{"square", 0.0, 0.3, {{{1.0, 0.0}, {2.0, 0.0}, {2.0, 1.0}, {1.0, 1.0}}}};
  // A quarter turn to the left and 5 m to the right: x from 4 to 5, y from 1 to 2.
  const OccupancyGrid marked = with_keep_out(room_of(10.0, 6.0), {square}, {5.0, 0.0, kPi / 2.0});
  EXPECT_EQ(marked.at(90, 30), 100);
  EXPECT_EQ(marked.at(70, 30), 0);
  EXPECT_EQ(marked.at(90, 50), 0);
}

TEST(KeepOut, HolesStayFreeAndMapsStayThemselves) {
  const Silhouette frame{"frame",
                         0.0,
                         0.3,
                         {{{1.0, 1.0}, {4.0, 1.0}, {4.0, 4.0}, {1.0, 4.0}},
                          {{2.0, 2.0}, {2.0, 3.0}, {3.0, 3.0}, {3.0, 2.0}}}};
  const OccupancyGrid map = room_of(10.0, 6.0);
  const OccupancyGrid marked = with_keep_out(map, {frame}, {});
  EXPECT_EQ(marked.at(50, 50), 0);
  EXPECT_EQ(marked.at(30, 30), 100);
  EXPECT_EQ(with_keep_out(map, {}, {}).cells, map.cells);
  const Silhouette beyond{"beyond", 0.0, 0.3, {{{-5.0, -5.0}, {-4.0, -5.0}, {-4.0, 50.0}}}};
  EXPECT_EQ(with_keep_out(map, {beyond}, {}).cells, map.cells);
}

}  // namespace
}  // namespace tagfield
