// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/map_view.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

const Extent kContent(Eigen::Vector2d(-2.0, -3.0), Eigen::Vector2d(4.0, 5.0));

TEST(MakeMap, ScalesBothAxesEqually) {
  const MapView map = make_map("m", kContent, {}, 0.0);
  const Place origin = on_map(map, {0.0, 0.0, 0.0});
  const Place east = on_map(map, {1.0, 0.0, 0.0}) - origin;
  const Place north = on_map(map, {0.0, 1.0, 7.0}) - origin;
  EXPECT_NEAR(east.x(), map.scale, 1e-9);
  EXPECT_NEAR(north.y(), -map.scale, 1e-9);
  EXPECT_NEAR(east.y(), 0.0, 1e-9);
  EXPECT_NEAR(north.x(), 0.0, 1e-9);
}

TEST(MakeMap, ShowsTheContentWhole) {
  const MapView map = make_map("m", kContent, {}, 0.0);
  EXPECT_LT(map.axes.x.low, -2.0);
  EXPECT_GT(map.axes.x.high, 4.0);
  EXPECT_LT(map.axes.y.low, -3.0);
  EXPECT_GT(map.axes.y.high, 5.0);
}

TEST(MakeMap, ShowsTheGeometryNearButNotFarAway) {
  const Silhouette wall{"wall", 0.0, 3.0, {{{-3.0, -4.0}, {500.0, -4.0}, {500.0, -5.0}}}};
  const MapView map = make_map("m", kContent, {wall}, 0.0);
  EXPECT_LT(map.axes.y.low, -4.5);
  EXPECT_LT(map.axes.x.high, 10.0);
}

TEST(MakeMap, TakesAPointAndALine) {
  const MapView point = make_map("m", Extent(Eigen::Vector2d(1.0, 1.0)), {}, 0.0);
  EXPECT_GT(point.axes.x.high - point.axes.x.low, 0.05);
  const MapView line =
      make_map("m", Extent(Eigen::Vector2d(0.0, 0.0), Eigen::Vector2d(50.0, 0.0)), {}, 0.0);
  EXPECT_GT(map_bottom(line), 200.0);
}

TEST(DrawLabel, KeepsOffWhatIsTaken) {
  MapView map = make_map("m", kContent, {}, 0.0);
  const Place center = on_map(map, {1.0, 1.0, 0.0});
  Svg svg;
  for (int i = 0; i < 9; ++i) draw_label(svg, map, center, "tag");
  EXPECT_LE(map.taken.size(), 4U);
  for (std::size_t i = 0; i < map.taken.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) EXPECT_FALSE(map.taken[i].intersects(map.taken[j]));
  }
}

}  // namespace
}  // namespace tagfield
