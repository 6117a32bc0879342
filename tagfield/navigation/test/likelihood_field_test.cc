// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/likelihood_field.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

OccupancyGrid random_map(std::uint32_t seed) {
  std::mt19937 generator(seed);
  OccupancyGrid map;
  map.width = 40;
  map.height = 30;
  map.origin = {-0.75, 1.5};
  for (int i = 0; i < map.width * map.height; ++i) {
    const auto draw = generator() % 40;
    map.cells.push_back(draw == 0 ? 100 : draw < 10 ? -1 : 0);
  }
  return map;
}

/// Thrun's formula for the endpoint's cell, by checking all cells; at the map's border as
/// documented.
double brute_force(const OccupancyGrid& map, const Eigen::Vector2d& end_M, double sigma) {
  double least = 16.0 * sigma * sigma;
  Eigen::Vector2i cell = map.cell_of(end_M);
  if (cell.x() == -1) cell.x() = 0;
  if (cell.y() == -1) cell.y() = 0;
  const bool inside = cell.minCoeff() >= 0 && cell.x() < map.width - 1 && cell.y() < map.height - 1;
  for (int y = 0; inside && y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      if (!is_occupied(map.at(x, y))) continue;
      const Eigen::Vector2d away = map.centre_of(x, y) - map.centre_of(cell.x(), cell.y());
      least = std::min(least, away.squaredNorm());
    }
  }
  return std::log(0.9 * std::exp(-least / (2.0 * sigma * sigma)) + 0.1 / 3.0);
}

RC_GTEST_PROP(LikelihoodField, IsThatOfTheNearestOccupiedCell, (std::uint32_t seed)) {
  const OccupancyGrid map = random_map(seed);
  const double sigma = 0.1;
  const LikelihoodField field(map, sigma);
  const auto from = [](int low, int high) { return 0.05 * *rc::gen::inRange(low, high) + 0.0213; };
  const PlanarPose pose{from(-40, 60), from(0, 80), from(-60, 60)};
  const std::vector<Eigen::Vector2f> ends = {{0.3F, 0.1F}, {-0.5F, 0.72F}, {2.0F, -1.1F}};
  double expected = 0.0;
  for (const Eigen::Vector2f& end : ends) {
    const Eigen::Vector2d p = transformed(pose, end.cast<double>());
    // On an edge between cells, rounding may choose either.
    const Eigen::Vector2d in_cells = (p - map.origin) / map.resolution_m;
    const Eigen::Vector2d to_edge = (in_cells.array() - in_cells.array().round()).abs().matrix();
    RC_PRE(to_edge.minCoeff() > 1e-4);
    expected += brute_force(map, p, sigma);
  }
  RC_ASSERT(std::abs(field.log_likelihood(pose, ends) - expected) < 1e-4);
}

TEST(LikelihoodField, TakesPosesFarOffAndNotFinite) {
  const LikelihoodField field(random_map(1), 0.1);
  const double off = std::log(0.9 * std::exp(-8.0) + 0.1 / 3.0);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double x : {-1e3, 1e300, nan}) {
    EXPECT_NEAR(field.log_likelihood({x, 0.0, 0.0}, {{1.0F, 1.0F}}), off, 1e-6) << x;
  }
  EXPECT_EQ(field.log_likelihood({}, {}), 0.0);
}

}  // namespace
}  // namespace tagfield
