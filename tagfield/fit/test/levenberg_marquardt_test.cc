// SPDX-License-Identifier: Apache-2.0
#include "tagfield/fit/levenberg_marquardt.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>

namespace tagfield {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

struct Point {
  Vector2d x;
  Matrix2d normal;
  Vector2d gradient;
  double cost = 0.0;
};

/// Point for residuals with the Jacobian J, whose squares are to be minimized.
Point point_of(const Vector2d& x, const Eigen::VectorXd& residuals, const Eigen::MatrixX2d& J) {
  return {x, J.transpose() * J, -J.transpose() * residuals, residuals.squaredNorm()};
}

/// Rosenbrock's valley: residuals 10 (y - x^2) and 1 - x, 0 at (1, 1).
Point in_valley(const Vector2d& x) {
  Eigen::MatrixX2d J(2, 2);
  J << -20.0 * x[0], 10.0, -1.0, 0.0;
  return point_of(x, Vector2d(10.0 * (x[1] - x[0] * x[0]), 1.0 - x[0]), J);
}

/// A line fitted to four points.
Point on_line(const Vector2d& x) {
  Eigen::MatrixX2d J(4, 2);
  J << 1.0, 0.0, 1.0, 1.0, 1.0, 2.0, 1.0, 3.0;
  return point_of(x, J * x - Eigen::Vector4d(1.0, 3.0, 4.0, 9.0), J);
}

template <typename At>
Point descended(const At& at, const Vector2d& start, const LevenbergMarquardt& how) {
  return descend(at(start), how, [&](const Point& here, double damping) -> std::optional<Point> {
    const Vector2d move = damped(here.normal, damping).ldlt().solve(here.gradient);
    if (!is_worthwhile(move, 1e-10)) return std::nullopt;
    return at(here.x + move);
  });
}

// By hand: the mean abscissa is 1.5, the mean value 4.25, the slope 12.5 / 5.
TEST(LevenbergMarquardt, FitsALineAsTheClosedFormDoes) {
  const Point best = descended(on_line, {100.0, -100.0}, {});
  EXPECT_NEAR(best.x[1], 2.5, 1e-9);
  EXPECT_NEAR(best.x[0], 4.25 - 1.5 * 2.5, 1e-9);
}

TEST(LevenbergMarquardt, FollowsRosenbrocksValley) {
  const Point best = descended(in_valley, {-1.2, 1.0}, {.max_steps = 100});
  EXPECT_LT((best.x - Vector2d(1.0, 1.0)).norm(), 1e-8);
}

TEST(LevenbergMarquardt, NeverGoesUphill) {
  double before = in_valley({-1.2, 1.0}).cost;
  for (int steps = 1; steps < 20; ++steps) {
    const double cost = descended(in_valley, {-1.2, 1.0}, {.max_steps = steps}).cost;
    EXPECT_LE(cost, before) << steps;
    before = cost;
  }
}

TEST(LevenbergMarquardt, RefusesWhatIsNoNumber) {
  struct Place {
    double x = 0.0;
    double cost = 0.0;
  };
  double last_damping = 0.0;
  const auto step = [&](const Place& here, double damping) -> std::optional<Place> {
    last_damping = damping;
    return Place{here.x + 1.0, std::nan("")};
  };
  const Place best = descend(Place{3.0, 7.0}, {.damping = 1.0, .max_damping = 500.0}, step);
  EXPECT_EQ(best.x, 3.0);
  EXPECT_EQ(last_damping, 100.0);
}

TEST(LevenbergMarquardt, EndsAtTheLeastGain) {
  struct Place {
    double x = 0.0;
    double cost = 0.0;
  };
  // Each step gains half as much as the previous one.
  const auto halved = [](const Place& here, double) -> std::optional<Place> {
    return Place{here.x + 1.0, 0.5 * here.cost};
  };
  EXPECT_EQ(descend(Place{0.0, 1.0}, {.min_gain = 0.1}, halved).x, 4.0);
  EXPECT_EQ(descend(Place{0.0, 64.0}, {.min_relative_gain = 0.9}, halved).x, 7.0);
}

TEST(Damped, HasMoreOnItsDiagonal) {
  const Matrix2d normal = (Matrix2d() << 4.0, 1.0, 1.0, 3.0).finished();
  EXPECT_EQ(damped(normal, 0.5, 0.25), (Matrix2d() << 6.25, 1.0, 1.0, 4.75).finished());
  EXPECT_EQ(evenly_damped(normal, 0.5, 0.25), (Matrix2d() << 7.75, 1.0, 1.0, 6.75).finished());
}

}  // namespace
}  // namespace tagfield
