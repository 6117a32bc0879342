// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_transforms.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "adapters/bags/test/tf2_lookup.h"

namespace tagfield {
namespace {

using Rng = std::mt19937_64;

constexpr int kFrames = 7;

double uniform(Rng& rng, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(rng);
}

std::string frame(int i) { return fmt::format("f{}", i); }

int random_below(Rng& rng, int count) {
  return std::min(static_cast<int>(uniform(rng, 0.0, count)), count - 1);
}

RigidTransform random_pose(Rng& rng) {
  const auto any = [&] { return uniform(rng, -1.0, 1.0); };
  return {Eigen::Quaterniond(any(), any(), any(), any()).normalized(), {any(), any(), any()}};
}

/// Frames with parents among the earlier ones; now and then one changes its parent, or there are
/// two trees. Steps are under half a second, so that there is no gap.
std::vector<StampedTransform> random_tree(Rng& rng) {
  std::vector<StampedTransform> transforms;
  for (int i = 1; i < kFrames; ++i) {
    const std::string first = frame(random_below(rng, i));
    const std::string second = uniform(rng, 0.0, 1.0) < 0.2 ? frame(random_below(rng, i)) : first;
    if (uniform(rng, 0.0, 1.0) < 0.1) continue;
    if (uniform(rng, 0.0, 1.0) < 0.3) {
      transforms.push_back({Time{}, first, frame(i), random_pose(rng), true});
      continue;
    }
    const double end_s = uniform(rng, 7.0, 10.0);
    for (double t = uniform(rng, 1.0, 3.0); t < end_s; t += uniform(rng, 0.05, 0.49)) {
      const std::string& parent = t < 5.0 ? first : second;
      transforms.push_back({time_from_seconds(t), parent, frame(i), random_pose(rng), false});
    }
  }
  return transforms;
}

bool occurs(const std::string& name, const std::vector<StampedTransform>& transforms) {
  return std::any_of(transforms.begin(), transforms.end(), [&](const StampedTransform& transform) {
    return transform.child == name || transform.parent == name;
  });
}

std::vector<RecordedUpdate> random_updates(const std::vector<StampedTransform>& transforms,
                                           const std::string& of, Rng& rng) {
  std::vector<RecordedUpdate> updates;
  for (int i = 0; i < 20; ++i)
    updates.push_back({time_from_seconds(uniform(rng, 0.5, 10.5)), "a", of});
  // Some at the very stamps of transforms.
  for (std::size_t i = 0; i < transforms.size(); i += 9) {
    if (!transforms[i].is_static) updates.push_back({transforms[i].stamp, "a", of});
  }
  std::sort(updates.begin(), updates.end(),
            [](const auto& a, const auto& b) { return a.stamp < b.stamp; });
  return updates;
}

TEST(BagTransforms, AreThoseOfTf2) {
  Rng rng(1);
  int known = 0;
  int unknown = 0;
  for (int i = 0; i < 300; ++i) {
    const std::vector<StampedTransform> transforms = random_tree(rng);
    const std::string F = frame(random_below(rng, kFrames));
    const std::string B = frame(random_below(rng, kFrames));
    // tf2 has a pose of a frame in itself even if it never heard of it.
    if (!occurs(B, transforms) || !occurs(F, transforms)) continue;
    const std::vector<RecordedUpdate> updates = random_updates(transforms, B, rng);
    const TransformedPoses found = poses_from_transforms(transforms, updates, {F});
    std::size_t at = 0;
    for (const RecordedUpdate& update : updates) {
      const auto expected = tf2_lookup(transforms, F, B, update.stamp);
      const bool is_there = at < found.poses.size() && found.poses[at].stamp == update.stamp;
      ASSERT_EQ(is_there, expected.has_value()) << i << ": " << B << " in " << F;
      ++(is_there ? known : unknown);
      if (!is_there) continue;
      const RigidTransform& X = found.poses[at++].X_WA;
      EXPECT_LT((X.translation - expected->translation).norm(), 1e-9);
      EXPECT_LT(X.rotation.angularDistance(expected->rotation), 1e-7);
    }
  }
  EXPECT_GT(known, 1000);
  EXPECT_GT(unknown, 1000);
}

TEST(BagTransforms, OfALoopThereAreNone) {
  const auto link = [](const char* parent, const char* child) {
    return StampedTransform{Time{}, parent, child, {}, true};
  };
  const TransformedPoses found =
      poses_from_transforms({link("a", "b"), link("b", "c"), link("c", "a")},
                            {{time_from_seconds(1.0), "x", "c"}}, {"a"});
  EXPECT_TRUE(found.poses.empty());
}

}  // namespace
}  // namespace tagfield
