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

RC_GTEST_PROP(PlaneInReach, TellsOfPlacesAroundWhatEachTellsOfItself, ()) {
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
  const PlaneInReach plane(phases, 1.0, range);
  const Reach reach(phases, range);
  for (int k = 0; k < 300; ++k) {
    const Eigen::Vector2d middle{made::uniform(rng, -11.0, 11.0), made::uniform(rng, -11.0, 11.0)};
    const double radius = made::uniform(rng, 0.0, 1.5);
    const PlaneInReach::Surrounding around = plane.around(middle, radius);
    const PlaneInReach::Part part = around.part;
    for (int at = 0; at < 9; ++at) {
      const double angle = 0.25 * kPi * at;
      const Eigen::Vector2d p =
          middle + (at < 8 ? radius : 0.0) * Eigen::Vector2d(std::cos(angle), std::sin(angle));
      const bool holds = reach.holds({p.x(), p.y(), 1.0});
      RC_ASSERT(plane.holds(around, p) == holds);
      if (part == PlaneInReach::Part::kAll) RC_ASSERT(holds);
      if (part == PlaneInReach::Part::kNone) RC_ASSERT(!holds);
    }
  }
}

/// With one antenna, only areas that the circle of its reach crosses are examined more closely.
TEST(PlaneInReach, LooksCloserOnlyWhereSomePlacesAreInReachAndSomeAreNot) {
  TagPhases phases;
  phases.value = phases.x = phases.y = phases.z = Eigen::ArrayXd::Zero(1);
  const PlaneInReach plane(phases, 3.0, 5.0);  // A circle of 4 m, seen from above.
  using Part = PlaneInReach::Part;
  EXPECT_EQ(plane.around({2.0, 0.0}, 0.5).part, Part::kAll);
  EXPECT_EQ(plane.around({4.1, 0.0}, 0.5).part, Part::kMixed);
  EXPECT_EQ(plane.around({0.0, 5.0}, 0.5).part, Part::kNone);
}

}  // namespace
}  // namespace tagfield
