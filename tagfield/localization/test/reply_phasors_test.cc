// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/internal/reply_phasors.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "made_reads.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

using Eigen::Vector3d;

constexpr double kCarrierHz = 866.3e6;

Vector3d anywhere(made::Rng& rng, double most) {
  return {made::uniform(rng, -most, most), made::uniform(rng, -most, most),
          made::uniform(rng, -0.3 * most, 0.3 * most)};
}

/// Waves from an antenna some metres away and from weaker images of it further away.
std::vector<TracedWave> some_waves(made::Rng& rng) {
  const Vector3d antenna = Vector3d(3.0, 0.0, 0.0) + anywhere(rng, 1.5);
  std::vector<TracedWave> waves = {{antenna, {0.8, -0.6}, Vector3d::UnitX(), true}};
  const auto images = static_cast<std::size_t>(rng() % 6);
  for (std::size_t i = 0; i < images; ++i) {
    const double gain = made::uniform(rng, 0.0, 0.6);
    waves.push_back({anywhere(rng, 20.0) + Vector3d(30.0, 0.0, 0.0),
                     std::polar(gain * 8.0, made::uniform(rng, 0.0, kTwoPi)), Vector3d::UnitX(),
                     false});
  }
  return waves;
}

/// Field by the definition, in double precision, with amplitudes as at `about`.
std::complex<double> field_at(const std::vector<TracedWave>& waves, const Vector3d& p,
                              const Vector3d& about) {
  const double k = kTwoPi / wavelength(kCarrierHz);
  std::complex<double> sum = 0.0;
  for (const TracedWave& wave : waves) {
    sum += wave.amplitude / (about - wave.source_W).norm() *
           std::polar(1.0, -k * (p - wave.source_W).norm());
  }
  return sum;
}

std::complex<double> field_at(const std::vector<TracedWave>& waves, const Vector3d& p) {
  return field_at(waves, p, p);
}

double directness_at(const std::vector<TracedWave>& waves, const Vector3d& p) {
  double all = 0.0;
  for (const TracedWave& wave : waves) all += std::abs(wave.amplitude) / (p - wave.source_W).norm();
  return std::abs(waves.front().amplitude) / (p - waves.front().source_W).norm() / all;
}

/// Phase of the forward path minus that of the direct wave [rad], near 0.
double bend_at(const std::vector<TracedWave>& waves, const Vector3d& p, const Vector3d& about) {
  return -std::arg(field_at(waves, p, about) / field_at({waves.front()}, p, about));
}

/// [m/m], by finite differences. The decrease of amplitude with distance is neglected, as in
/// bends.h.
Vector3d slope_at(const std::vector<TracedWave>& waves, const Vector3d& p) {
  constexpr double kStep = 1e-6;
  const double k = kTwoPi / wavelength(kCarrierHz);
  Vector3d slope;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    const std::complex<double> turned =
        std::polar(1.0, bend_at(waves, p + step, p) - bend_at(waves, p - step, p));
    slope[axis] = std::arg(turned) / (2.0 * kStep * k);
  }
  return slope;
}

bool is_near_a_null(const std::vector<TracedWave>& waves, const Vector3d& p) {
  double all = 0.0;
  for (const TracedWave& wave : waves) all += std::abs(wave.amplitude) / (p - wave.source_W).norm();
  return std::abs(field_at(waves, p)) < 0.1 * all;
}

RC_GTEST_PROP(ReplyPhasors, AreWhatTheWavesComeToByTheDefinition, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  TracedReply reply{some_waves(rng), {}};
  if (rng() % 2 == 0) reply.backward = some_waves(rng);
  const std::vector<TracedWave>& back = reply.backward.empty() ? reply.forward : reply.backward;
  const Vector3d middle = anywhere(rng, 0.5);
  Tile x, y, z;
  std::vector<Vector3d> places;
  for (int i = 0; i < kTile; ++i) {
    const Eigen::Vector3f off = anywhere(rng, 0.3).cast<float>();
    x[i] = off.x();
    y[i] = off.y();
    z[i] = off.z();
    places.push_back(middle + off.cast<double>());
  }
  const ReplyPhasors there = reply_phasors(near_reply(reply, middle, kCarrierHz), x, y, z);
  for (int i = 0; i < kTile; ++i) {
    const Vector3d& p = places[static_cast<std::size_t>(i)];
    if (is_near_a_null(reply.forward, p) || is_near_a_null(back, p)) continue;
    const std::complex<double> product = field_at(reply.forward, p) * field_at(back, p);
    const std::complex<double> expected = std::conj(product) / std::abs(product);
    RC_ASSERT(std::abs(static_cast<double>(there.in_phase[i]) - expected.real()) < 0.01);
    RC_ASSERT(std::abs(static_cast<double>(there.quadrature[i]) - expected.imag()) < 0.01);
    const double direct = std::min(directness_at(reply.forward, p), directness_at(back, p));
    RC_ASSERT(std::abs(static_cast<double>(there.directness[i]) - direct) < 1e-4);
    const double slope = 0.5 * (slope_at(reply.forward, p) + slope_at(back, p)).norm();
    RC_ASSERT(std::abs(static_cast<double>(there.slope[i]) - slope) < 0.02 * (1.0 + slope));
  }
}

RC_GTEST_PROP(ReplyPhasors, AreTheSameBitsForEachSetOfInstructions, ()) {
  made::Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const NearReply reply = near_reply({some_waves(rng), some_waves(rng)}, {}, kCarrierHz);
  Tile x, y, z;
  for (int i = 0; i < kTile; ++i) {
    const Eigen::Vector3f off = anywhere(rng, 0.3).cast<float>();
    x[i] = off.x();
    y[i] = off.y();
    z[i] = off.z();
  }
  const ReplyPhasors baseline = reply_phasors(reply, x, y, z, InstructionSet::kBaseline);
  const ReplyPhasors other = reply_phasors(reply, x, y, z, *rc::gen::elementOf(instruction_sets()));
  RC_ASSERT((baseline.in_phase == other.in_phase).all());
  RC_ASSERT((baseline.quadrature == other.quadrature).all());
  RC_ASSERT((baseline.directness == other.directness).all());
  RC_ASSERT((baseline.slope == other.slope).all());
}

TEST(ReplyPhasors, HaveNoDirectnessWhereTheDirectPathIsBlocked) {
  made::Rng rng(3);
  std::vector<TracedWave> waves = some_waves(rng);
  while (waves.size() < 2) waves = some_waves(rng);
  waves.erase(waves.begin());
  const Tile zero = Tile::Zero();
  const ReplyPhasors there =
      reply_phasors(near_reply({waves, {}}, {}, kCarrierHz), zero, zero, zero);
  EXPECT_EQ(there.directness.maxCoeff(), 0.0f);
  const ReplyPhasors nothing = reply_phasors(near_reply({}, {}, kCarrierHz), zero, zero, zero);
  EXPECT_EQ(nothing.directness.maxCoeff(), 0.0f);
  EXPECT_TRUE(nothing.in_phase.isFinite().all() && nothing.slope.isFinite().all());
}

}  // namespace
}  // namespace tagfield
