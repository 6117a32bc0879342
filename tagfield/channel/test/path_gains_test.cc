// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/path_gains.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/test/any_end.h"

namespace tagfield {
namespace {

using Complex = std::complex<double>;
using Eigen::Vector3d;

Vector3d any_unit_vector(RandomStream& stream) {
  Vector3d v;
  do {
    v = Vector3d(between(stream, -1, 1), between(stream, -1, 1), between(stream, -1, 1));
  } while (v.norm() < 0.1 || v.norm() > 1.0);
  return v.normalized();
}

/// One box of each known material, and of a hollow one, of one with a stated loss, of one without a
/// wave's length of wall and of one far too thick.
RadioWorld world_of_all() {
  std::vector<Material> materials = known_materials();
  const auto add = [&](const std::string& name, std::optional<double> wall_m,
                       std::optional<double> crossing_db) {
    Material material = find_material(known_materials(), "wood");
    material.name = name;
    material.wall_m = wall_m;
    material.crossing_db = crossing_db;
    materials.push_back(material);
  };
  add("carton", 0.004, {});
  add("stated", {}, 7.5);
  add("film", 0.0, {});
  add("mountain", 1e7, {});
  Scene scene;
  RadioWorldOptions options;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    scene.collisions.push_back({fmt::format("box{}", i), Box{Vector3d::Ones()},
                                from_translation({3.0 * static_cast<double>(i), 0.0, 0.0})});
    options.rules.push_back({fmt::format("box{}", i), materials[i], {}});
  }
  Diagnostics diagnostics;
  return radio_world(scene, options, diagnostics);
}

/// A path of the given number of surfaces. Its gain doesn't depend on where the surfaces are, only
/// on their normals.
RadioPath any_path(RandomStream& stream, const RadioWorld& world, std::size_t crossings) {
  RadioPath path;
  path.length_m = between(stream, 0.3, 40.0);
  path.departure_W = any_unit_vector(stream);
  path.bounce_count = static_cast<int>(stream() % (kMaxBounces + 1));
  Vector3d k = path.departure_W;
  const auto any_solid = [&] {
    return static_cast<std::uint32_t>(stream() % world.material_of.size());
  };
  const auto bounces = static_cast<std::size_t>(path.bounce_count);
  for (std::size_t i = 0; i < bounces; ++i) {
    Bounce& bounce = path.bounces[i];
    bounce.solid = any_solid();
    bounce.normal_W = any_unit_vector(stream);
    if (bounce.normal_W.dot(k) > 0.0) bounce.normal_W = -bounce.normal_W;
    k -= 2.0 * k.dot(bounce.normal_W) * bounce.normal_W;
  }
  path.arrival_W = k;
  for (std::size_t i = 0; i < crossings; ++i) {
    Crossing through;
    through.solid = any_solid();
    through.leg = static_cast<int>(stream() % (bounces + 1));
    through.length_m = stream() % 3 == 0 ? 0.0 : between(stream, 0.001, 2.0);
    through.cos_incidence = uniform(stream);
    through.normal_W = any_unit_vector(stream);
    path.crossings.push_back(through);
  }
  std::stable_sort(path.crossings.begin(), path.crossings.end(),
                   [](const Crossing& a, const Crossing& b) { return a.leg < b.leg; });
  return path;
}

class PathGains : public testing::Test {
 protected:
  void expect_same_as_one_by_one(std::uint64_t seed) {
    RandomStream stream(seed, Purpose::kPlaces);
    const AntennaPattern antenna = any_pattern(stream);
    const AntennaPattern tag = any_pattern(stream);
    const RigidTransform X_WA = any_pose(stream);
    const RigidTransform X_WT = any_pose(stream);
    const ChannelEffects effects{stream() % 4 != 0, stream() % 4 != 0};
    std::vector<RadioPath> paths;
    for (std::uint64_t count = stream() % 150; count-- > 0;) {
      paths.push_back(any_path(stream, world_, stream() % 4));
    }
    if (!paths.empty()) spoil(stream, X_WA, antenna, paths);
    std::vector<Complex> gains(paths.size());
    path_gains(paths, {antenna, X_WA}, {tag, X_WT}, world_, carrier_, effects, gains);
    for (std::size_t i = 0; i < paths.size(); ++i) {
      const Complex alone =
          path_gain(paths[i], {antenna, X_WA}, {tag, X_WT}, world_, carrier_, effects);
      // An isotropic antenna's of the same length, before anything attenuates it.
      const double free = std::sqrt(peak_gain(antenna) * peak_gain(tag)) * carrier_.lambda_m /
                          (4.0 * kPi * std::max(paths[i].length_m, 0.01));
      EXPECT_LT(std::abs(gains[i] - alone), 1e-9 * free) << "seed " << seed << ", path " << i;
      compared_ += std::abs(alone) > 1e-6 * free ? 1U : 0U;
    }
    expect_same_bytes(paths, {antenna, X_WA}, {tag, X_WT}, effects, gains);
  }

  /// Paths for which lanes aren't made: at normal incidence, along the antenna's wire, through many
  /// surfaces, without length and extremely long.
  void spoil(RandomStream& stream, const RigidTransform& X_WA, const AntennaPattern& antenna,
             std::vector<RadioPath>& paths) {
    const auto any = [&]() -> RadioPath& { return paths[stream() % paths.size()]; };
    RadioPath& straight = any();
    straight.crossings.assign(1, {});
    straight.crossings[0].normal_W = -straight.departure_W;
    any().departure_W =
        X_WA.rotation * Vector3d(0.0, std::sin(antenna.tilt_rad), std::cos(antenna.tilt_rad));
    any() = any_path(stream, world_, 14 + stream() % 30);
    any().length_m = 0.0;
    any().length_m = 1e7;
  }

  void expect_same_bytes(const std::vector<RadioPath>& paths, const RadioEnd& antenna,
                         const RadioEnd& tag, const ChannelEffects& effects,
                         const std::vector<Complex>& expected) {
    for (const InstructionSet set : instruction_sets()) {
      for (const std::size_t step : {std::size_t{1}, std::size_t{7}, std::size_t{500}}) {
        std::vector<Complex> gains(paths.size());
        for (std::size_t begin = 0; begin < paths.size(); begin += step) {
          const std::size_t count = std::min(step, paths.size() - begin);
          path_gains(std::span(paths).subspan(begin, count), antenna, tag, world_, carrier_,
                     effects, std::span(gains).subspan(begin, count), set);
        }
        ASSERT_EQ(std::memcmp(gains.data(), expected.data(), gains.size() * sizeof(Complex)), 0)
            << "set " << static_cast<int>(set) << ", batches of " << step;
      }
    }
  }

  RadioWorld world_ = world_of_all();
  Carrier carrier_ = carrier_in(world_, 865.7e6);
  std::size_t compared_ = 0;
};

TEST_F(PathGains, AreThoseOfPathsOneByOneOnEachInstructionSetAndInAnyBatch) {
  for (std::uint64_t seed = 1; seed <= 200; ++seed) expect_same_as_one_by_one(seed);
  EXPECT_GT(compared_, 5000U);
}

}  // namespace
}  // namespace tagfield
