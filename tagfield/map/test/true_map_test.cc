// SPDX-License-Identifier: Apache-2.0
#include "tagfield/map/true_map.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tagfield/base/test/error_text.h"
#include "tagfield/world/triangulate.h"

namespace tagfield {
namespace {

void add_box(Scene& scene, const Eigen::Vector2d& low, const Eigen::Vector2d& high) {
  const Eigen::Vector2d size = high - low;
  const Eigen::Vector2d centre = 0.5 * (low + high);
  scene.collisions.push_back(
      {"box", Box{{size.x(), size.y(), 2.0}}, from_translation({centre.x(), centre.y(), 1.0})});
}

/// Four walls 0.2 m thick around free ground from (0, 0) to (6, 4), and a box in it from (2, 1) to
/// (3, 3), all offset from the cells' borders by 0.02 m.
Scene room() {
  constexpr double o = 0.02;
  Scene scene;
  add_box(scene, {-0.2 + o, -0.2 + o}, {6.2 + o, 0.0 + o});
  add_box(scene, {-0.2 + o, 4.0 + o}, {6.2 + o, 4.2 + o});
  add_box(scene, {-0.2 + o, -0.2 + o}, {0.0 + o, 4.2 + o});
  add_box(scene, {6.0 + o, -0.2 + o}, {6.2 + o, 4.2 + o});
  add_box(scene, {2.0 + o, 1.0 + o}, {3.0 + o, 3.0 + o});
  scene.collisions.push_back({"ground", Plane{}, {}});
  return scene;
}

std::int8_t value_at(const OccupancyGrid& grid, double x, double y) {
  const Eigen::Vector2i cell = grid.cell_of({x, y});
  return grid.at(cell.x(), cell.y());
}

std::ptrdiff_t count(const OccupancyGrid& grid, std::int8_t value) {
  return std::count(grid.cells.begin(), grid.cells.end(), value);
}

TEST(TrueMap, OfARoomWithABox) {
  const OccupancyGrid grid = true_map(room(), 0.3, {1.0, 2.0}, 0.1);
  EXPECT_EQ(value_at(grid, 1.0, 2.0), 0);
  EXPECT_EQ(value_at(grid, 5.9, 3.9), 0);
  EXPECT_EQ(value_at(grid, 2.5, 2.0), -1);    // Inside the box.
  EXPECT_EQ(value_at(grid, 6.15, 2.0), -1);   // Inside a wall.
  EXPECT_EQ(value_at(grid, 6.22, 2.0), -1);   // A wall's far face.
  EXPECT_EQ(value_at(grid, 6.9, 2.0), -1);    // Outdoors.
  EXPECT_EQ(value_at(grid, 6.02, 2.0), 100);  // A wall's near face.
  EXPECT_EQ(value_at(grid, 2.02, 2.0), 100);
  // Wall faces are in cells 0 and 60 along x, 0 and 40 along y, those of the box in 20 to 30 and 10
  // to 30, inclusive. This leaves 59 × 39 free cells, minus the box's 11 × 21.
  EXPECT_EQ(count(grid, 0), 59 * 39 - 11 * 21);
  EXPECT_EQ(count(grid, 100), 2 * 61 + 2 * 39 + 2 * 11 + 2 * 19);
}

TEST(TrueMap, CoversAllSurfacesByAMargin) {
  const OccupancyGrid grid = true_map(room(), 0.3, {1.0, 2.0}, 0.1);
  // From −0.18 − 1 to 6.22 + 1 and to 4.22 + 1, rounded outward to whole cells.
  EXPECT_NEAR(grid.origin.x(), -1.2, 1e-12);
  EXPECT_NEAR(grid.origin.y(), -1.2, 1e-12);
  EXPECT_EQ(grid.width, 85);
  EXPECT_EQ(grid.height, 65);
}

TEST(TrueMap, AMeshIsAsItsBox) {
  Scene meshes = room();
  for (Collision& collision : meshes.collisions) {
    if (std::holds_alternative<Plane>(collision.shape)) continue;
    collision.shape = std::make_shared<const TriangleMesh>(triangulate(collision.shape));
  }
  EXPECT_EQ(true_map(meshes, 0.3, {1.0, 2.0}, 0.05).cells,
            true_map(room(), 0.3, {1.0, 2.0}, 0.05).cells);
}

TEST(TrueMap, OfAnEmptyWorldIsFree) {
  const OccupancyGrid grid = true_map(Scene{}, 0.3, {1.0, 2.0}, 0.5);
  EXPECT_EQ(grid.width, 4);
  EXPECT_EQ(count(grid, 0), 16);
}

TEST(TrueMap, OutdoorsFreeGroundReachesTheMapsRim) {
  Scene scene;
  add_box(scene, {0.02, 0.02}, {1.02, 1.02});
  const OccupancyGrid grid = true_map(scene, 0.3, {-0.5, 0.5}, 0.1);
  EXPECT_EQ(grid.cells.front(), 0);
  EXPECT_EQ(grid.cells.back(), 0);
  EXPECT_EQ(count(grid, 100), 40);
  EXPECT_EQ(count(grid, -1), 81);
}

TEST(TrueMap, SurfacesOnBordersAreInTheGreaterCell) {
  // 0.1 has no exact double: 0.3/0.1 is 2.9999999999999996, and 0.6/0.1 is 5.999999999999999.
  Scene scene;
  add_box(scene, {0.3, 0.3}, {0.6, 0.9});
  const OccupancyGrid grid = true_map(scene, 0.3, {0.0, 0.0}, 0.1);
  EXPECT_EQ(value_at(grid, 0.25, 0.45), 0);
  EXPECT_EQ(value_at(grid, 0.35, 0.45), 100);
  EXPECT_EQ(value_at(grid, 0.45, 0.45), -1);
  EXPECT_EQ(value_at(grid, 0.55, 0.45), -1);
  EXPECT_EQ(value_at(grid, 0.65, 0.45), 100);
  EXPECT_EQ(value_at(grid, 0.75, 0.45), 0);
}

TEST(TrueMap, RoomsThatCannotBeEnteredAreUnknown) {
  Scene scene = room();
  // A closet around (5, 3). Its walls could be a mesh without thickness; here they are solids.
  add_box(scene, {4.52, 2.52}, {5.52, 2.62});
  add_box(scene, {4.52, 3.42}, {5.52, 3.52});
  add_box(scene, {4.52, 2.52}, {4.62, 3.52});
  add_box(scene, {5.42, 2.52}, {5.52, 3.52});
  const OccupancyGrid outside = true_map(scene, 0.3, {1.0, 2.0}, 0.05);
  EXPECT_EQ(value_at(outside, 5.0, 3.0), -1);
  EXPECT_EQ(value_at(outside, 4.63, 3.0), -1);   // The closet's inner face.
  EXPECT_EQ(value_at(outside, 4.53, 3.0), 100);  // Its outer face.
  const OccupancyGrid inside = true_map(scene, 0.3, {5.0, 3.0}, 0.05);
  EXPECT_EQ(value_at(inside, 5.0, 3.0), 0);
  EXPECT_EQ(value_at(inside, 1.0, 2.0), -1);
  EXPECT_EQ(value_at(inside, 4.63, 3.0), 100);
  EXPECT_EQ(value_at(inside, 4.53, 3.0), -1);
}

RC_GTEST_PROP(TrueMap, WallsOfAnySlantAreTight, ()) {
  // A rotated room without a door: free cells stay inside, and their area is that of the room.
  const double yaw = 1e-3 * *rc::gen::inRange(-3000, 3000);
  const double x = 1e-3 * *rc::gen::inRange(-3000, 3000);
  const double resolution = 1e-3 * *rc::gen::inRange(20, 200);
  Scene scene;
  scene.collisions = {
      {"room", Box{{5.0, 3.0, 2.0}}, from_xyz_rpy({x, 1.0, 0.5}, {0.1, 0.05, yaw})}};
  const OccupancyGrid grid = true_map(scene, 0.3, {x, 1.0}, resolution);
  RC_ASSERT(grid.cells.front() == -1);
  const auto area = static_cast<double>(count(grid, 0)) * resolution * resolution;
  // The walls' cells occupy less than two cells along the outline of about 16 m.
  RC_ASSERT(area < 15.6);
  RC_ASSERT(area > 15.0 - 2.0 * 16.5 * resolution);
  // Each occupied cell is adjacent to a free one; no free cell shares a side with an unknown one.
  for (int v = 0; v < grid.height; ++v) {
    for (int u = 0; u < grid.width; ++u) {
      if (grid.at(u, v) != 0) continue;
      for (const auto& [i, j] : {std::pair{1, 0}, {-1, 0}, {0, 1}, {0, -1}}) {
        RC_ASSERT(grid.at(u + i, v + j) != -1);
      }
    }
  }
}

RC_GTEST_PROP(TrueMap, MarksTheCellsThatASurfacePassesAndNoOthers, ()) {
  const double yaw = 1e-3 * *rc::gen::inRange(-3000, 3000);
  const Eigen::Vector2d centre(1e-3 * *rc::gen::inRange(-500, 500), 0.4);
  const Eigen::Rotation2Dd R_WC(yaw);
  Scene scene;
  scene.collisions = {
      {"box", Box{{4.0, 3.0, 2.0}}, from_xyz_rpy({centre.x(), centre.y(), 0.5}, {0.0, 0.0, yaw})}};
  const OccupancyGrid grid = true_map(scene, 0.3, {5.0, 5.0}, 0.1);
  // Points along the four sides, one per millimetre.
  std::vector<bool> passed(grid.cells.size(), false);
  for (int mm = 0; mm <= 14'000; ++mm) {
    const double s = 1e-3 * mm;
    const Eigen::Vector2d p_C = s < 4.0    ? Eigen::Vector2d(s - 2.0, -1.5)
                                : s < 7.0  ? Eigen::Vector2d(2.0, s - 5.5)
                                : s < 11.0 ? Eigen::Vector2d(9.0 - s, 1.5)
                                           : Eigen::Vector2d(-2.0, 12.5 - s);
    const Eigen::Vector2i cell = grid.cell_of(centre + R_WC * p_C);
    passed[grid.index(cell.x(), cell.y())] = true;
  }
  int unseen = 0;
  for (std::size_t i = 0; i < passed.size(); ++i) {
    if (passed[i] && std::abs(yaw) > 1e-3) RC_ASSERT(grid.cells[i] == 100);
    unseen += grid.cells[i] == 100 && !passed[i] ? 1 : 0;
  }
  // Cells cut at a corner by less than a millimetre.
  RC_ASSERT(unseen <= 12);
}

TEST(TrueMap, ReachesNoFurtherThanAsked) {
  const OccupancyGrid grid = true_map(room(), 0.3, {1.0, 2.0}, 0.1, 1.5);
  // From −0.5 m to 2.5 m along x and 0.5 m to 3.5 m along y: the western wall and the box.
  EXPECT_EQ(value_at(grid, 0.02, 2.0), 100);
  EXPECT_EQ(value_at(grid, 2.02, 2.0), 100);
  EXPECT_EQ(value_at(grid, 1.0, 0.55), 0);
  EXPECT_EQ(value_at(grid, 1.0, 0.45), -1);  // Free, but beyond the reach.
  EXPECT_LT(grid.width, 60);
}

TEST(TrueMap, RefusesBadArguments) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto message = [](double z, const Eigen::Vector2d& start, double resolution, double reach) {
    return error_of([&] { true_map(room(), z, start, resolution, reach); });
  };
  EXPECT_EQ(message(0.3, {1.0, 2.0}, 0.1, 100.0), "(no error)");
  EXPECT_EQ(message(0.3, {2.05, 2.0}, 0.1, 100.0),
            "true map: the start (2.05, 2) is in a cell with a surface at 0.3 m");
  EXPECT_TRUE(contains(message(nan, {1.0, 2.0}, 0.1, 100.0), "height"));
  EXPECT_TRUE(contains(message(0.3, {1.0, nan}, 0.1, 100.0), "start"));
  EXPECT_TRUE(contains(message(0.3, {1.0, 2.0}, 0.0, 100.0), "resolution"));
  EXPECT_TRUE(contains(message(0.3, {1.0, 2.0}, nan, 100.0), "resolution"));
  EXPECT_TRUE(contains(message(0.3, {1.0, 2.0}, 1e-5, 100.0), "at most 4e8 cells"));
  EXPECT_TRUE(contains(message(0.3, {1.0, 2.0}, 0.1, 0.0), "reach"));
  EXPECT_TRUE(contains(message(0.3, {1.0, 2.0}, 0.1, nan), "reach"));
}

// --- Comparison ---------------------------------------------------------------------------------

/// 40 × 30 cells of free ground with walls on cells 5 and 34 along x, 5 and 24 along y.
OccupancyGrid walls() {
  OccupancyGrid grid;
  grid.width = 40;
  grid.height = 30;
  grid.origin = {-1.0, 0.5};
  grid.cells.assign(1200, -1);
  for (int y = 5; y <= 24; ++y) {
    for (int x = 5; x <= 34; ++x) {
      const bool wall = x == 5 || x == 34 || y == 5 || y == 24;
      grid.cells[grid.index(x, y)] = wall ? std::int8_t{100} : std::int8_t{0};
    }
  }
  return grid;
}
constexpr std::size_t kWallCells = 2 * 30 + 2 * 18;

TEST(CompareMaps, AMapIsAsItself) {
  const MapComparison result = compare_maps(walls(), walls());
  EXPECT_EQ(result.true_cells, kWallCells);
  EXPECT_EQ(result.mapped_cells, kWallCells);
  EXPECT_EQ(result.found_share, 1.0);
  EXPECT_EQ(result.false_share, 0.0);
  EXPECT_EQ(result.double_wall_share, 0.0);
  EXPECT_EQ(result.known_share, 1.0);
}

TEST(CompareMaps, AMapMayStandAnywhereInItsFrame) {
  // The same walls in a larger map, whose cells are shifted by a third of a cell.
  const OccupancyGrid small = walls();
  OccupancyGrid large;
  large.width = 60;
  large.height = 50;
  large.origin = small.origin - Eigen::Vector2d(10.3 * 0.05, 4.7 * 0.05);
  large.cells.assign(3000, -1);
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) large.cells[large.index(x + 10, y + 5)] = small.at(x, y);
  }
  for (const auto& result : {compare_maps(large, small), compare_maps(small, large)}) {
    EXPECT_EQ(result.true_cells, kWallCells);
    EXPECT_EQ(result.mapped_cells, kWallCells);
    EXPECT_EQ(result.found_share, 1.0);
    EXPECT_EQ(result.false_share, 0.0);
    EXPECT_EQ(result.known_share, 1.0);
  }
}

TEST(CompareMaps, CountsWhatIsMissing) {
  OccupancyGrid map = walls();
  // The left wall is missing except for one cell; two free cells are unknown.
  for (int y = 6; y <= 23; ++y)
    map.cells[map.index(5, y)] = y == 15 ? std::int8_t{100} : std::int8_t{0};
  map.cells[map.index(20, 20)] = -1;
  map.cells[map.index(21, 20)] = 40;
  const MapComparison result = compare_maps(map, walls());
  EXPECT_EQ(result.mapped_cells, kWallCells - 17);
  // Found: the cell, its two neighbours, and those next to the corners; 13 of 18 are not.
  EXPECT_DOUBLE_EQ(result.found_share, 1.0 - 13.0 / kWallCells);
  EXPECT_EQ(result.false_share, 0.0);
  EXPECT_DOUBLE_EQ(result.known_share, 1.0 - 2.0 / (28.0 * 18.0));
}

/// `walls()` as a map with a shifted origin.
OccupancyGrid shifted(double cells) {
  OccupancyGrid map = walls();
  map.origin.x() += 0.05 * cells;
  return map;
}

TEST(CompareMaps, OfAShiftedMap) {
  const MapComparison one = compare_maps(shifted(1.0), walls());
  EXPECT_EQ(one.found_share, 1.0);
  EXPECT_EQ(one.false_share, 0.0);
  const MapComparison two = compare_maps(shifted(2.0), walls());
  // Shifted by two cells: of the walls along y, only the ends of the right one are found, next to
  // the walls along x; nothing is false.
  EXPECT_DOUBLE_EQ(two.found_share, 1.0 - (20.0 + 16.0) / kWallCells);
  EXPECT_EQ(two.false_share, 0.0);
  const MapComparison five = compare_maps(shifted(5.0), walls());
  // Shifted by five cells: 14 of the 18 cells of each wall along y have no true wall within two
  // cells; for the right one, neither do its ends and the last three, protruding cells of the walls
  // along x.
  EXPECT_DOUBLE_EQ(five.false_share, (14.0 + 20.0 + 2.0 * 2.0) / kWallCells);
}

TEST(CompareMaps, CountsADoubleWall) {
  OccupancyGrid map = walls();
  // A second left wall five cells into the room, 8 cells long.
  for (int y = 10; y < 18; ++y) map.cells[map.index(10, y)] = 100;
  const MapComparison result = compare_maps(map, walls());
  EXPECT_EQ(result.found_share, 1.0);
  EXPECT_DOUBLE_EQ(result.false_share, 8.0 / (kWallCells + 8.0));
  // Cells within eight rows of it, and for the walls along x within eight columns: all of the left
  // wall's cells y = 5 … 24 (10 − 8 to 17 + 8), the lower wall's cells x = 5 … 18 (10 − 5 rows
  // away) and the upper wall's (24 − 17 rows away): 20 + 2·13.
  EXPECT_DOUBLE_EQ(result.double_wall_share, (20.0 + 13.0 + 13.0) / kWallCells);
}

TEST(CompareMaps, AThickWallIsNotADoubleOne) {
  OccupancyGrid map = walls();
  // The left wall is smeared over six cells: false, but not double.
  for (int x = 6; x <= 10; ++x) {
    for (int y = 6; y <= 23; ++y) map.cells[map.index(x, y)] = 100;
  }
  const MapComparison result = compare_maps(map, walls());
  EXPECT_GT(result.false_share, 0.2);
  // But next to it, along the walls along x, it is across free cells.
  OccupancyGrid only = walls();
  for (int y = 0; y < 30; ++y) {
    for (int x = 0; x < 40; ++x) {
      const bool left = x <= 10 && y >= 6 && y <= 23;
      if (!left && only.at(x, y) == 100 && x != 5) only.cells[only.index(x, y)] = 0;
    }
  }
  EXPECT_EQ(compare_maps(map, only).double_wall_share, 0.0);
}

TEST(CompareMaps, AWallBehindUnknownCellsIsNotADouble) {
  OccupancyGrid map = walls();
  // Five cells behind the left wall, with unknown cells between.
  for (int y = 10; y < 18; ++y) map.cells[map.index(0, y)] = 100;
  EXPECT_EQ(compare_maps(map, walls()).double_wall_share, 0.0);
}

TEST(CompareMaps, OfNothingIsNothing) {
  OccupancyGrid nothing;
  const MapComparison result = compare_maps(nothing, nothing);
  EXPECT_EQ(result.true_cells, 0U);
  EXPECT_EQ(result.found_share, 0.0);
  EXPECT_EQ(result.known_share, 0.0);
  EXPECT_EQ(compare_maps(nothing, walls()).found_share, 0.0);
  EXPECT_EQ(compare_maps(walls(), nothing).false_share, 1.0);
}

TEST(CompareMaps, RefusesDifferentResolutions) {
  OccupancyGrid coarse = walls();
  coarse.resolution_m = 0.1;
  EXPECT_EQ(error_of([&] { compare_maps(coarse, walls()); }),
            "maps of 0.1 m and 0.05 m a cell can't be compared");
}

RC_GTEST_PROP(CompareMaps, AgreesWithTheDefinitionsWordByWord, ()) {
  const auto any_map = [] {
    OccupancyGrid grid;
    grid.width = *rc::gen::inRange(1, 16);
    grid.height = *rc::gen::inRange(1, 16);
    grid.origin = {0.05 * *rc::gen::inRange(-5, 5), 0.05 * *rc::gen::inRange(-5, 5)};
    const int rarity = *rc::gen::inRange(1, 30);
    for (int i = 0; i < grid.width * grid.height; ++i) {
      const int draw = *rc::gen::inRange(0, 3 * rarity);
      grid.cells.push_back(static_cast<std::int8_t>(draw == 0 ? 100 : (draw % 3 == 1 ? -1 : 0)));
    }
    return grid;
  };
  const OccupancyGrid map = any_map();
  const OccupancyGrid truth = any_map();
  const auto occupied_centres = [](const OccupancyGrid& grid) {
    std::vector<Eigen::Vector2d> centres;
    for (int y = 0; y < grid.height; ++y) {
      for (int x = 0; x < grid.width; ++x) {
        if (is_occupied(grid.at(x, y))) centres.push_back(grid.centre_of(x, y));
      }
    }
    return centres;
  };
  const auto mapped = occupied_centres(map);
  const auto truly = occupied_centres(truth);
  const auto near = [](const Eigen::Vector2d& p, const std::vector<Eigen::Vector2d>& all, int n) {
    return std::any_of(all.begin(), all.end(), [&](const Eigen::Vector2d& q) {
      return (p - q).cwiseAbs().maxCoeff() < 0.05 * (n + 0.5);
    });
  };
  const auto found =
      std::count_if(truly.begin(), truly.end(), [&](const auto& p) { return near(p, mapped, 1); });
  const auto wrong = std::count_if(mapped.begin(), mapped.end(),
                                   [&](const auto& p) { return !near(p, truly, 2); });
  const MapComparison result = compare_maps(map, truth);
  RC_ASSERT(result.true_cells == truly.size());
  RC_ASSERT(result.mapped_cells == mapped.size());
  const auto whole = [](double share, std::size_t of) {
    return std::lround(share * static_cast<double>(of));
  };
  RC_ASSERT(whole(result.found_share, truly.size()) == found);
  RC_ASSERT(whole(result.false_share, mapped.size()) == wrong);
}

}  // namespace
}  // namespace tagfield
