// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/hit_grid.h"

#include <gtest/gtest.h>

#include <thread>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// One beam along x from the origin to `x`.
ScanPoints beam_to(double x) { return {{0.0, 0.0}, {{x, 0.0}}, {}}; }

TEST(HitGrid, BeginsUnknown) {
  const HitGrid grid(0.05);
  EXPECT_FALSE(grid.at(0, 0).is_known());
  EXPECT_FALSE(grid.at(-1000, 1000).is_known());
  const OccupancyGrid map = grid.to_occupancy();
  EXPECT_EQ(map.cells, std::vector<std::int8_t>(9, -1));
}

TEST(HitGrid, ABeamFreesItsWayAndHitsItsEnd) {
  HitGrid grid(0.1);
  for (int i = 0; i < 2; ++i) grid.insert(beam_to(1.04), {0.0, 0.05, 0.0});
  EXPECT_TRUE(grid.at(10, 0).is_occupied());
  for (int x = 0; x < 9; ++x) {
    EXPECT_EQ(grid.at(x, 0).passed, 2U) << x;
    EXPECT_FALSE(grid.at(x, 0).is_occupied()) << x;
  }
  // Cells just before the endpoint and beyond it stay unknown.
  EXPECT_FALSE(grid.at(9, 0).is_known());
  EXPECT_FALSE(grid.at(11, 0).is_known());
  EXPECT_FALSE(grid.at(5, 1).is_known());
}

TEST(HitGrid, TheMeanOfTheEndsIsFinerThanTheCell) {
  HitGrid grid(0.1);
  for (const double x : {1.01, 1.02, 1.06}) grid.insert(beam_to(x), {0.0, 0.05, 0.0});
  const HitCell& cell = grid.at(10, 0);
  ASSERT_EQ(cell.hits, 3U);
  EXPECT_NEAR(grid.mean_of(10, 0, cell).x(), 1.03, 1e-6);
  EXPECT_NEAR(grid.mean_of(10, 0, cell).y(), 0.05, 1e-6);
}

TEST(HitGrid, ScansAreCountedNotBeams) {
  // A wall along x at grazing incidence: in each scan, one beam ends in a cell and many pass it.
  HitGrid grid(0.1);
  ScanPoints scan{{0.0, 0.5}, {}, {}};
  for (int i = 0; i < 40; ++i) scan.ends_R.emplace_back(2.0 + 0.06 * i, 0.02);
  for (int i = 0; i < 2; ++i) grid.insert(scan, {});
  for (int x = 21; x < 43; ++x) {
    EXPECT_EQ(grid.at(x, 0).ended, 2U) << x;
    EXPECT_EQ(grid.at(x, 0).passed, 0U) << x;
    EXPECT_TRUE(grid.at(x, 0).is_occupied()) << x;
  }
}

TEST(HitGrid, WhatWentAwayIsForgottenInTime) {
  HitGrid grid(0.1);
  for (int i = 0; i < 2; ++i) grid.insert(beam_to(1.04), {0.0, 0.05, 0.0});
  // Two of twenty scans are one in ten.
  for (int i = 0; i < 18; ++i) grid.insert(beam_to(3.04), {0.0, 0.05, 0.0});
  EXPECT_TRUE(grid.at(10, 0).is_occupied());
  grid.insert(beam_to(3.04), {0.0, 0.05, 0.0});
  EXPECT_FALSE(grid.at(10, 0).is_occupied());
}

TEST(HitGrid, GrowsInAllDirectionsAndTurnsScans) {
  HitGrid grid(0.05);
  for (int quarter = 0; quarter < 4; ++quarter) {
    for (int i = 0; i < 2; ++i) grid.insert(beam_to(7.02), {0.02, 0.02, quarter * kPi / 2.0});
  }
  EXPECT_TRUE(grid.at(140, 0).is_occupied());
  EXPECT_TRUE(grid.at(-140, 0).is_occupied());
  EXPECT_TRUE(grid.at(0, 140).is_occupied());
  EXPECT_TRUE(grid.at(0, -140).is_occupied());
}

// The last grid to change a shared patch changes it in place, after the others have read it to copy
// it.
TEST(HitGrid, CopiesAreChangedByThreadsAtOnce) {
  std::vector<HitGrid> grids(1, HitGrid(0.1));
  grids[0].insert(beam_to(1.04), {0.0, 0.05, 0.0});
  grids.resize(4, grids[0]);
  {
    std::vector<std::jthread> threads;
    threads.reserve(grids.size());
    for (HitGrid& grid : grids) {
      threads.emplace_back([&grid] { grid.insert(beam_to(1.04), {0.0, 0.05, 0.0}); });
    }
  }
  for (const HitGrid& grid : grids) {
    EXPECT_EQ(grid.at(10, 0).hits, 2U);
    EXPECT_EQ(grid.at(5, 0).passed, 2U);
  }
}

TEST(HitGrid, CopiesAreTheirOwn) {
  HitGrid one(0.05);
  one.insert(beam_to(2.0), {});
  HitGrid other = one;
  other.insert(beam_to(2.0), {});
  EXPECT_EQ(one.at(3, 0).passed, 1U);
  EXPECT_EQ(other.at(3, 0).passed, 2U);
}

TEST(HitGrid, OccupancyHasAllThatWasSeenWithAMargin) {
  HitGrid grid(0.1);
  for (int i = 0; i < 2; ++i) grid.insert(beam_to(0.95), {0.05, 0.05, 0.0});
  const OccupancyGrid map = grid.to_occupancy();
  EXPECT_EQ(map.width, 13);  // cells 0 to 10, and one on each side
  EXPECT_EQ(map.height, 3);
  EXPECT_NEAR(map.origin.x(), -0.1, 1e-12);
  EXPECT_EQ(map.at(1, 1), 0);
  EXPECT_EQ(map.at(11, 1), 100);
  EXPECT_EQ(map.at(0, 0), -1);
}

}  // namespace
}  // namespace tagfield
