// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/conic.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>

#include <algorithm>

#include "made_reads.h"

namespace tagfield {
namespace {

using made::Rng;
using made::uniform;

Eigen::Vector3d anywhere(Rng& rng, double reach, double low, double high) {
  return {uniform(rng, -reach, reach), uniform(rng, -reach, reach), uniform(rng, low, high)};
}

/// The conic of a tag at `p` and antenna positions AP_0, AP_1.
Conic through(const Eigen::Vector3d& p, const Eigen::Vector3d& AP0, const Eigen::Vector3d& AP1) {
  return {AP0, AP1 - AP0, (p - AP1).norm() - (p - AP0).norm()};
}

double nearest_of(const std::vector<Eigen::Vector2d>& points, const Eigen::Vector3d& p) {
  double best = 1e9;
  for (const Eigen::Vector2d& point : points) best = std::min(best, (point - p.head<2>()).norm());
  return best;
}

/// Brute-force minimum of the sum of both misfits, on a grid that is refined around its best cell.
Eigen::Vector2d brute_force(const Conic& a, const Conic& b, double z, Eigen::Vector2d centre,
                            double reach) {
  const auto misfits = [&](const Eigen::Vector2d& p) {
    const Eigen::Vector3d at(p.x(), p.y(), z);
    return std::abs(misfit(a, at)) + std::abs(misfit(b, at));
  };
  for (; reach > 1e-7; reach *= 0.5) {
    Eigen::Vector2d best = centre;
    for (int i = -20; i <= 20; ++i) {
      for (int j = -20; j <= 20; ++j) {
        const Eigen::Vector2d p = centre + reach / 20.0 * Eigen::Vector2d(i, j);
        if (misfits(p) < misfits(best)) best = p;
      }
    }
    centre = best;
  }
  return centre;
}

/// Whether the crossing is far from singular, so that the result is about as accurate as the input.
bool crosses_well(const Conic& a, const Conic& b, const Eigen::Vector3d& p, double least = 1e-3) {
  const auto slope = [&](const Conic& conic) -> Eigen::Vector2d {
    const Eigen::Vector3d far = p - conic.focus - conic.baseline;
    const Eigen::Vector3d near = p - conic.focus;
    return far.head<2>() / far.norm() - near.head<2>() / near.norm();
  };
  const Eigen::Vector2d u = slope(a);
  const Eigen::Vector2d v = slope(b);
  return std::abs(u.x() * v.y() - u.y() * v.x()) > least;
}

TEST(Conic, OfOneFocusMeetInTheTagAtAnyHeights) {
  rc::check([] {
    Rng rng(*rc::gen::arbitrary<std::uint64_t>());
    const Eigen::Vector3d p = anywhere(rng, 5.0, 0.0, 2.0);
    const Eigen::Vector3d focus = anywhere(rng, 2.0, 0.0, 1.0);
    const Conic a = through(p, focus, anywhere(rng, 2.0, 0.0, 1.0));
    const Conic b = through(p, focus, anywhere(rng, 2.0, 0.0, 1.0));
    if (!crosses_well(a, b, p)) return;
    std::vector<Eigen::Vector2d> points;
    intersect_common_focus(a, b, p.z(), points);
    const double sine =
        std::abs(a.baseline.x() * b.baseline.y() - a.baseline.y() * b.baseline.x()) /
        (a.baseline.head<2>().norm() * b.baseline.head<2>().norm());
    if (sine < 0.03) return;  // taken as parallel, see the next tests
    RC_ASSERT(nearest_of(points, p) < 1e-6);
    for (const Eigen::Vector2d& point : points) {
      const Eigen::Vector3d at(point.x(), point.y(), p.z());
      RC_ASSERT(std::abs(misfit(a, at)) < 1e-6);  // on the branch of its sign
      RC_ASSERT(std::abs(misfit(b, at)) < 1e-6);
    }
  });
}

TEST(Conic, OfOneFocusAgreesWithBruteForce) {
  Rng rng(4);
  for (int i = 0; i < 20; ++i) {
    const Eigen::Vector3d p = anywhere(rng, 4.0, 0.5, 1.5);
    const Eigen::Vector3d focus = anywhere(rng, 1.0, 0.3, 0.5);
    const Conic a = through(p, focus, focus + Eigen::Vector3d(1.0, 0.1, 0.0));
    const Conic b = through(p, focus, focus + Eigen::Vector3d(0.2, -0.8, 0.3));
    std::vector<Eigen::Vector2d> points;
    intersect_common_focus(a, b, p.z(), points);
    for (const Eigen::Vector2d& point : points) {
      if (!crosses_well(a, b, {point.x(), point.y(), p.z()}, 0.05)) continue;
      const Eigen::Vector2d near = point + Eigen::Vector2d(0.013, -0.021);
      EXPECT_LT((brute_force(a, b, p.z(), near, 0.05) - point).norm(), 1e-5);
    }
    EXPECT_LT(nearest_of(points, p), 1e-6);
  }
}

TEST(Conic, OnAStraightPathGivesBothMirrorImages) {
  const Eigen::Vector3d p(1.0, 2.0, 0.9);
  const Eigen::Vector3d focus(0.0, 0.0, 0.4);
  std::vector<Eigen::Vector2d> points;
  intersect_common_focus(through(p, focus, {1.0, 0.0, 0.4}), through(p, focus, {2.5, 0.0, 0.4}),
                         p.z(), points);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_LT(nearest_of(points, p), 1e-9);
  EXPECT_LT(nearest_of(points, {1.0, -2.0, 0.9}), 1e-9);
}

TEST(Conic, ALittleNoiseAtADoubleRootLosesNoPoint) {
  // A tag on the line through the antenna's positions, with a millimetre of noise outwards.
  const Eigen::Vector3d focus(0.0, 0.0, 0.0);
  std::vector<Eigen::Vector2d> points;
  intersect_common_focus({focus, {1.0, 0.0, 0.0}, -0.2}, {focus, {2.0, 0.0, 0.0}, 0.801}, 0.0,
                         points);
  EXPECT_FALSE(points.empty());
  for (const Eigen::Vector2d& point : points) EXPECT_NEAR(point.x(), 0.6, 0.01);
}

TEST(Conic, VerticalBaselinesMeetNowhere) {
  const Eigen::Vector3d p(1.0, 2.0, 0.9);
  std::vector<Eigen::Vector2d> points;
  intersect_common_focus(through(p, {0.0, 0.0, 0.0}, {0.0, 0.0, 0.5}),
                         through(p, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.5}), p.z(), points);
  EXPECT_TRUE(points.empty());
}

TEST(Conic, NoiseCanMakeItImpossible) {
  EXPECT_FALSE(is_usable({{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, 0.31}));
  EXPECT_FALSE(is_usable({{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}, 0.0}));
  EXPECT_TRUE(is_usable({{0.0, 0.0, 0.0}, {0.3, 0.0, 0.0}, -0.29}));
}

TEST(TracedConic, LiesOnTheCurve) {
  Rng rng(5);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector3d p = anywhere(rng, 4.0, 0.0, 1.5);
    const Conic conic = through(p, anywhere(rng, 2.0, 0.0, 1.0), anywhere(rng, 2.0, 0.0, 1.0));
    for (const auto& row : trace(conic, p.z()).rows) {
      for (const auto& point : row) {
        if (!point.valid) continue;
        EXPECT_NEAR(misfit(conic, {point.p.x(), point.p.y(), p.z()}), 0.0, 1e-7);
      }
    }
  }
}

TEST(TracedConic, ReachesFifteenMetresToEitherSide) {
  for (const double away : {-14.9, -10.0, 10.0, 14.9}) {
    const Eigen::Vector3d p(1.0, away, 0.4);
    const Conic a = through(p, {-0.3, 0.0, 0.4}, {0.3, 0.0, 0.4});
    const Conic b = through(p, {2.0, 1.0, 0.4}, {2.4, 1.3, 0.4});
    std::vector<Eigen::Vector2d> points;
    intersect_traced(trace(a, p.z()), b, p.z(), points);
    EXPECT_LT(nearest_of(points, p), 1e-5) << away;
  }
}

TEST(TracedConic, OfOtherFociMeetsInTheTag) {
  Rng rng(6);
  int tried = 0;
  int found = 0;
  for (int i = 0; i < 500; ++i) {
    const Eigen::Vector3d p = anywhere(rng, 4.0, 0.4, 1.0);
    const Eigen::Vector3d first = anywhere(rng, 3.0, 0.4, 0.4);
    const Eigen::Vector3d second = anywhere(rng, 3.0, 0.4, 0.4);
    const Conic a = through(p, first, first + anywhere(rng, 0.7, 0.0, 0.0));
    const Conic b = through(p, second, second + anywhere(rng, 0.7, 0.0, 0.0));
    if (!crosses_well(a, b, p)) continue;
    std::vector<Eigen::Vector2d> points;
    intersect_traced(trace(a, p.z()), b, p.z(), points);
    ++tried;
    if (nearest_of(points, p) < 1e-6) ++found;
  }
  EXPECT_GT(tried, 200);
  // Two crossings between two points of the trace can be missed.
  EXPECT_GE(found, tried * 98 / 100);
}

}  // namespace
}  // namespace tagfield
