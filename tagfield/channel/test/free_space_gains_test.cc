// SPDX-License-Identifier: Apache-2.0
#include "tagfield/channel/free_space_gains.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <vector>

#include "tagfield/base/random.h"
#include "tagfield/base/units.h"
#include "tagfield/channel/test/any_end.h"

namespace tagfield {
namespace {

struct Links {
  explicit Links(RandomStream& stream, std::size_t count)
      : antenna(any_pattern(stream)), tag(any_pattern(stream)), X_WA(any_pose(stream)) {
    for (std::size_t i = 0; i < count; ++i) X_WT.push_back(any_pose(stream));
    // Exactly along both wires, with coincident ends, and far outside the loops' domain.
    X_WT[0] = {X_WA.rotation,
               X_WA * Eigen::Vector3d(0.0, std::sin(antenna.tilt_rad), std::cos(antenna.tilt_rad))};
    X_WT[1] = X_WA;
    X_WT[2].translation = {1e6, 2e6, 0.0};
    effects = {stream() % 4 != 0, stream() % 4 != 0};
    const double lambda_m = wavelength(865.7e6);
    carrier = {lambda_m, kTwoPi / lambda_m, {}};
  }
  [[nodiscard]] std::vector<std::complex<double>> some(std::size_t begin, std::size_t count,
                                                       InstructionSet set) const {
    std::vector<std::complex<double>> gains(count);
    for (std::size_t i = 0; i < count; i += kStraightLinks) {
      std::vector<PoseRef> poses;
      const std::size_t end = std::min(count, i + kStraightLinks);
      for (std::size_t k = i; k < end; ++k) {
        poses.push_back({&X_WT[begin + k].rotation, &X_WT[begin + k].translation});
      }
      StraightLinks links;
      free_space_gains({antenna, X_WA}, tag, poses, carrier, effects, links, set);
      for (std::size_t k = i; k < end; ++k) gains[k] = {links.re[k - i], links.im[k - i]};
    }
    return gains;
  }
  AntennaPattern antenna;
  AntennaPattern tag;
  RigidTransform X_WA;
  std::vector<RigidTransform> X_WT;
  ChannelEffects effects;
  Carrier carrier;
};

// Against one link at a time with complex vectors and the standard library's functions.
RC_GTEST_PROP(FreeSpaceGains, AreThoseOfEachLink, ()) {
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), Purpose::kPlaces);
  const Links links(stream, 30);
  const auto gains = links.some(0, 30, instruction_sets().back());
  for (std::size_t i = 0; i < 30; ++i) {
    const RadioEnd antenna{links.antenna, links.X_WA};
    const RadioEnd tag{links.tag, links.X_WT[i]};
    const auto alone = free_space_gain(antenna, tag, links.carrier, links.effects);
    // The maximum for such a link, with matching polarizations.
    const double d = (tag.X_WA.translation - links.X_WA.translation).norm();
    const double most = d > 0.0 ? 10.0 * links.carrier.lambda_m / (4.0 * kPi * d) : 0.0;
    RC_ASSERT(std::abs(gains[i] - alone) <= 1e-12 * std::abs(alone) + 1e-14 * most);
  }
}

RC_GTEST_PROP(FreeSpaceGains, ComeWithTheirPowerAndSlope, ()) {
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), Purpose::kPlaces);
  const Links of(stream, 30);
  std::vector<PoseRef> poses;
  for (const RigidTransform& X : of.X_WT) poses.push_back({&X.rotation, &X.translation});
  StraightLinks links;
  free_space_gains({of.antenna, of.X_WA}, of.tag, poses, of.carrier, of.effects, links);
  for (std::size_t i = 0; i < 30; ++i) {
    const double power_db = to_db(std::norm(std::complex<double>(links.re[i], links.im[i])));
    RC_ASSERT(std::abs(links.power_db[i] - power_db) <= 1e-11);
    const Eigen::Vector3d way = of.X_WT[i].translation - of.X_WA.translation;
    Eigen::Vector3d expected = Eigen::Vector3d::Zero();
    if (links.power_db[i] > kNothing_db) expected = -of.carrier.wave_number * way.normalized();
    const Eigen::Vector3d found(links.slope_W.x[i], links.slope_W.y[i], links.slope_W.z[i]);
    RC_ASSERT((found - expected).norm() <= 1e-13);
  }
}

RC_GTEST_PROP(FreeSpaceGains, AreTheSameBitsInEveryBatchAndInstructionSet, ()) {
  RandomStream stream(*rc::gen::arbitrary<std::uint64_t>(), Purpose::kPlaces);
  const std::size_t count = 150;
  const Links links(stream, count);
  const auto all = links.some(0, count, InstructionSet::kBaseline);
  const std::size_t batch = *rc::gen::inRange<std::size_t>(1, count + 1);
  for (const InstructionSet set : instruction_sets()) {
    for (std::size_t begin = 0; begin < count; begin += batch) {
      const auto some = links.some(begin, std::min(batch, count - begin), set);
      for (std::size_t i = 0; i < some.size(); ++i) RC_ASSERT(some[i] == all[begin + i]);
    }
  }
}

}  // namespace
}  // namespace tagfield
