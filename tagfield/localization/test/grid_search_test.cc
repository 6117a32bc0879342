// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/grid_search.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "made_reads.h"
#include "tagfield/localization/holograms/reach.h"

namespace tagfield {
namespace {

using made::Rng;
using made::uniform;

/// Peaks of brightness, each lower than the previous one, and ripples that a glance can't
/// distinguish from them.
struct Hills {
  std::vector<Eigen::Vector2d> tops;
  double ripple = 0.0;

  [[nodiscard]] double light(double x, double y, double phase) const {
    constexpr double kWidth = 0.15;  // [m]
    double sum = ripple * (1.0 + std::sin(31.0 * x + phase) * std::cos(29.0 * y - phase));
    double height = 1.0;
    for (const Eigen::Vector2d& top : tops) {
      const double apart = (Eigen::Vector2d(x, y) - top).norm() / kWidth;
      sum += height * std::exp(-0.5 * apart * apart);
      height -= 0.1;
    }
    return sum;
  }
};

/// Random peaks at least 1 m apart, within 4 m.
Hills some_hills(Rng& rng, std::size_t count) {
  Hills hills;
  while (hills.tops.size() < count) {
    const Eigen::Vector2d top{uniform(rng, -2.8, 2.8), uniform(rng, -2.8, 2.8)};
    const bool is_apart =
        std::all_of(hills.tops.begin(), hills.tops.end(),
                    [&](const Eigen::Vector2d& other) { return (other - top).norm() > 1.0; });
    if (is_apart) hills.tops.push_back(top);
  }
  return hills;
}

/// A level that counts the positions evaluated.
GridLevel level_of(const Hills& hills, double phase, std::size_t& looks) {
  return [&hills, phase, &looks](const Tile& x, const Tile& y) {
    looks += kTile;
    Tile light;
    for (Eigen::Index k = 0; k < kTile; ++k) {
      light[k] = static_cast<float>(
          hills.light(static_cast<double>(x[k]), static_cast<double>(y[k]), phase));
    }
    return light;
  };
}

PlaneInReach circle_of_4_m() {
  TagPhases phases;
  phases.value = phases.x = phases.y = phases.z = Eigen::ArrayXd::Zero(1);
  return {phases, 0.0, 4.0};
}

TEST(GridSearch, WithGlancesFindsTheSameHillsAndLooksAtAHundredthOfTheCells) {
  Rng rng(7);
  const PlaneInReach in_reach = circle_of_4_m();
  const Grid grid{Eigen::Vector2d::Zero(), 0.02, 4.0};
  const auto cells = static_cast<double>(126'000);  // π 4²/0.02², those within 4 m.
  for (int round = 0; round < 5; ++round) {
    Hills hills = some_hills(rng, 3);
    hills.ripple = 0.2;
    std::size_t first = 0;
    std::size_t glanced = 0;
    std::size_t finest = 0;
    const std::vector<GridLevel> levels{level_of(hills, 0.0, first), level_of(hills, 0.0, finest)};
    const std::vector<GridMaximum> all = search_grid(grid, in_reach, levels, 3);
    EXPECT_NEAR(static_cast<double>(first), cells, 0.01 * cells);
    GridPreselection glances;
    glances.at_blocks = [&](const CellBlock& block) {
      BlockLight light;
      for (Eigen::Index j = 0; j < kBlock; ++j) {
        for (Eigen::Index i = 0; i < kBlock; ++i) {
          const auto cell = static_cast<double>(block.cell_m);
          light(i, j) = static_cast<float>(
              hills.light(static_cast<double>(block.x) + cell * static_cast<double>(i),
                          static_cast<double>(block.y) + cell * static_cast<double>(j), 1.0));
        }
      }
      return light;
    };
    glances.at_cells = level_of(hills, 2.0, glanced);
    first = 0;
    const std::vector<GridMaximum> found = search_grid(grid, in_reach, levels, 3, glances);
    EXPECT_NEAR(static_cast<double>(glanced), 0.1 * cells, 0.01 * cells);
    EXPECT_NEAR(static_cast<double>(first), 0.01 * cells, 0.002 * cells);
    ASSERT_EQ(found.size(), all.size());
    for (std::size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].p, all[i].p);
    // Ripples of 20 cm shift a peak by less than half of that.
    EXPECT_LT((found.front().p - hills.tops.front()).norm(), 0.1);
  }
}

/// A small grid keeps as many cells as are split.
TEST(GridSearch, AGlanceLeavesEnoughCellsToBeSplit) {
  const PlaneInReach in_reach = circle_of_4_m();
  Hills hills;
  hills.tops = {{1.0, 0.5}};
  std::size_t first = 0;
  std::size_t glanced = 0;
  GridPreselection glances;
  glances.at_blocks = [](const CellBlock&) { return BlockLight::Ones(); };
  glances.at_cells = level_of(hills, 0.0, glanced);
  const auto found = search_grid({Eigen::Vector2d::Zero(), 0.4, 4.0}, in_reach,
                                 {level_of(hills, 0.0, first)}, 1, glances);
  EXPECT_GE(first, 250U);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_LT((found.front().p - hills.tops.front()).norm(), 0.4);
}

/// If brightness is 0 everywhere, no cell is discarded.
TEST(GridSearch, AGlanceAtTheDarkLeavesAllCells) {
  std::size_t first = 0;
  const GridLevel dark = [&](const Tile&, const Tile&) {
    first += kTile;
    return Tile(Tile::Zero());
  };
  GridPreselection glances;
  glances.at_blocks = [](const CellBlock&) { return BlockLight(BlockLight::Constant(-1.0f)); };
  glances.at_cells = dark;
  const auto found =
      search_grid({Eigen::Vector2d::Zero(), 0.4, 4.0}, circle_of_4_m(), {dark}, 1, glances);
  EXPECT_EQ(found.size(), 1U);
}

}  // namespace
}  // namespace tagfield
