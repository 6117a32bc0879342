// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {
namespace {

/// Along x at 2 m/s from x = −1 at t = 10 s, a point every 0.1 s, y = 0.5; σx 10 mm, σvx 0.1 m/s.
Track belt_track() {
  Track track;
  for (int i = 0; i <= 10; ++i) {
    TrackPoint point;
    point.stamp = time_from_seconds(10.0 + 0.1 * i);
    point.p_WT = {-1.0 + 0.2 * i, 0.5, 0.8};
    point.v_WT = {2.0, 0.0, 0.0};
    point.covariance(0, 0) = 1e-4;
    point.covariance(3, 3) = 1e-2;
    track.points.push_back(point);
  }
  return track;
}

TEST(Passing, CrossesALineWhereItIs) {
  // A line across the belt at x = 0.3: 1.3 m at 2 m/s after t = 10 s.
  const auto passing = passing_of(belt_track(), {{0.3, 7.0}, kPi / 2.0});
  ASSERT_TRUE(passing);
  EXPECT_NEAR(to_seconds(passing->stamp), 10.65, 1e-9);
  EXPECT_NEAR(passing->sigma_s, 0.01 / 2.0, 1e-12);
}

TEST(Passing, ASlantedLineIsCrossedWhereTheTrackMeetsIt) {
  // Through the origin at 45°: crossed at x = y = 0.5. Normal to it, the position is known to 10 mm
  // / √2, and the speed is 2 m/s / √2.
  const auto passing = passing_of(belt_track(), {{0.0, 0.0}, kPi / 4.0});
  ASSERT_TRUE(passing);
  EXPECT_NEAR(to_seconds(passing->stamp), 10.75, 1e-9);
  EXPECT_NEAR(passing->sigma_s, 0.005, 1e-12);
}

TEST(Passing, NoneWhereTheTrackEndsBefore) {
  EXPECT_FALSE(passing_of(belt_track(), {{1.5, 0.0}, kPi / 2.0}));
  EXPECT_FALSE(nearest_of(belt_track(), {-3.0, 0.0, 0.0}));
  EXPECT_FALSE(passing_of(Track{}, {}));
}

TEST(Passing, NearestIsAtTheFootOfThePerpendicular) {
  const auto passing = nearest_of(belt_track(), {0.41, 2.0, 1.2});
  ASSERT_TRUE(passing);
  EXPECT_NEAR(to_seconds(passing->stamp), 10.705, 1e-9);
  // There, p − a is perpendicular to v.
  EXPECT_NEAR(passing->sigma_s, 0.005, 1e-9);
}

TEST(Passing, NearestIsWhereATagPassesNotWhereItStood) {
  // Stands for a second at x = −1, where its velocity is noise, then passes.
  Track track;
  for (int i = 0; i < 10; ++i) {
    TrackPoint point;
    point.stamp = time_from_seconds(9.0 + 0.1 * i);
    point.p_WT = {-1.0, 0.5, 0.8};
    point.v_WT = {i % 2 == 0 ? 1e-3 : -1e-3, 0.0, 0.0};
    track.points.push_back(point);
  }
  const Track passes = belt_track();
  track.points.insert(track.points.end(), passes.points.begin(), passes.points.end());
  const auto passing = nearest_of(track, {0.41, 2.0, 1.2});
  ASSERT_TRUE(passing);
  EXPECT_NEAR(to_seconds(passing->stamp), 10.705, 1e-9);
}

TEST(Passing, ProbabilityOfAnOrder) {
  const Passing first{"a", time_from_seconds(1.0), 0.03};
  const Passing second{"b", time_from_seconds(1.05), 0.04};
  // One sigma of the difference: Φ(1).
  EXPECT_NEAR(probability_before(first, second), 0.841344746, 1e-8);
  EXPECT_NEAR(probability_before(second, first), 1.0 - 0.841344746, 1e-8);
}

}  // namespace
}  // namespace tagfield
