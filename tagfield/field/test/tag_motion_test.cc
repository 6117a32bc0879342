// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_motion.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

using Eigen::Vector3d;

TEST(TagMotion, PosesLieOnTheLineBetweenTheLastTwoUpdates) {
  TagPopulation tags(1.0);
  tags.add(3, "moves", {1.0, 2.0, 0.5});
  TagMotion motion;
  EXPECT_FALSE(motion.seen());
  motion.see(tags, time_from_seconds(10.0));
  EXPECT_EQ(motion.velocity(3), Vector3d::Zero());
  tags.move(3, {1.4, 1.8, 0.5});
  motion.see(tags, time_from_seconds(10.2));
  EXPECT_EQ(motion.seen(), time_from_seconds(10.2));
  EXPECT_LT((motion.velocity(3) - Vector3d(2.0, -1.0, 0.0)).norm(), 1e-9);
  const RigidTransform quarter = motion.pose(3, time_from_seconds(10.05), tags);
  EXPECT_LT((quarter.translation - Vector3d(1.1, 1.95, 0.5)).norm(), 1e-9);
}

TEST(TagMotion, NothingIsKnownOfTagsThatAreNewOrForgotten) {
  TagPopulation tags(1.0);
  tags.add(0, "old", {0.0, 0.0, 0.0});
  TagMotion motion;
  motion.see(tags, time_from_seconds(1.0));
  tags.move(0, {1.0, 0.0, 0.0});
  tags.add(5, "new", {7.0, 0.0, 0.0});
  motion.see(tags, time_from_seconds(2.0));
  EXPECT_EQ(motion.pose(5, time_from_seconds(1.5), tags).translation, Vector3d(7.0, 0.0, 0.0));
  EXPECT_EQ(motion.velocity(5), Vector3d::Zero());
  motion.forget(0);
  EXPECT_EQ(motion.pose(0, time_from_seconds(1.5), tags).translation, Vector3d(1.0, 0.0, 0.0));
  EXPECT_EQ(motion.velocity(0), Vector3d::Zero());
}

}  // namespace
}  // namespace tagfield
