// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/reach.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "made_reads.h"

namespace tagfield {
namespace {

TEST(InReach, IsNearerThanTheRangeAtHalfOfTheReads) {
  TagPhases phases;
  phases.value = phases.x = phases.y = phases.z = Eigen::ArrayXd::Zero(4);
  phases.x << 0.0, 0.0, 10.0, 10.0;
  EXPECT_TRUE(Reach(phases, 2.0).holds({1.0, 0.0, 0.0}));
  EXPECT_FALSE(Reach(phases, 2.0).holds({5.0, 0.0, 0.0}));
  phases.x << 0.0, 10.0, 10.0, 10.0;
  EXPECT_FALSE(Reach(phases, 2.0).holds({1.0, 0.0, 0.0}));
}

/// Squares of a metre that the circle of reach only just cuts, at the corner that is furthest from
/// the antenna or nearest to it.
TEST(PlaneInReach, HoldsWhatIsWithinACircleRightIntoItsSquaresCorners) {
  TagPhases phases;
  phases.value = phases.x = phases.y = phases.z = Eigen::ArrayXd::Zero(1);
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0}) {
      PlaneInReach far(phases, 0.0, 5.975 * std::sqrt(2.0));
      EXPECT_TRUE(far.holds({5.96 * x, 5.96 * y})) << x << y;
      EXPECT_FALSE(far.holds({5.99 * x, 5.99 * y})) << x << y;
      PlaneInReach near(phases, 0.0, 5.025 * std::sqrt(2.0));
      EXPECT_TRUE(near.holds({5.01 * x, 5.01 * y})) << x << y;
      EXPECT_FALSE(near.holds({5.04 * x, 5.04 * y})) << x << y;
    }
  }
}

RC_GTEST_PROP(PlaneInReach, AgreesWithEachPlaceByItself, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  TagPhases phases;
  const auto count = static_cast<Eigen::Index>(1 + rng() % 90);
  phases.value = phases.x = phases.y = phases.z = Eigen::ArrayXd::Zero(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    phases.x[i] = made::uniform(rng, -4.0, 4.0);
    phases.y[i] = made::uniform(rng, -4.0, 4.0);
    phases.z[i] = made::uniform(rng, 0.0, 3.0);
  }
  const double range = made::uniform(rng, 0.5, 6.0);
  PlaneInReach plane(phases, 1.0, range);
  for (double x = -11.0; x < 11.0; x += 0.37) {
    for (double y = -11.0; y < 11.0; y += 0.37) {
      RC_ASSERT(plane.holds({x, y}) == Reach(phases, range).holds({x, y, 1.0}));
    }
  }
}

}  // namespace
}  // namespace tagfield
