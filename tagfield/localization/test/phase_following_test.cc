// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/phase_following.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tagfield/localization/test/made_reads.h"

namespace tagfield {
namespace {

double range_at(const PhaseSample& sample, const Eigen::Vector3d& p_WT) {
  return (p_WT - sample.p_WA).norm();
}

/// Largest jump between neighbours of unwrapped minus true distance, in half wavelengths.
double greatest_slip(const PhaseSegment& segment, const Eigen::Vector3d& p_WT) {
  double greatest = 0.0;
  for (std::size_t i = 1; i < segment.samples.size(); ++i) {
    const double followed = segment.distance_m[i] - segment.distance_m[i - 1];
    const double real = range_at(segment.samples[i], p_WT) - range_at(segment.samples[i - 1], p_WT);
    greatest = std::max(greatest, std::abs(followed - real));
  }
  return greatest / (0.5 * wavelength(865.7e6));
}

/// Whole cycles lost between the beginning and the end of a segment, each the mean of 20 reads.
int cycles_lost(const PhaseSegment& segment, const Eigen::Vector3d& p_WT) {
  constexpr std::size_t kMany = 20;
  const std::size_t count = segment.samples.size();
  if (count < 2 * kMany) return 0;
  double drift = 0.0;
  const auto error = [&](std::size_t i) {
    return segment.distance_m[i] - range_at(segment.samples[i], p_WT);
  };
  for (std::size_t i = 0; i < kMany; ++i) drift += error(count - 1 - i) - error(i);
  drift /= static_cast<double>(kMany) * 0.5 * wavelength(865.7e6);
  return static_cast<int>(std::abs(std::lround(drift)));
}

TEST(PhaseFollowing, GivesTheChangeOfDistance) {
  made::Rng rng(1);
  made::Noise none;
  none.phase_rad = 0.0;
  none.range_sigma = 0.0;
  const Eigen::Vector3d p_WT(3.0, 2.0, 0.4);
  const auto samples = made::read_along(made::s_curve(10.0, 0.02), p_WT, none, rng);
  const auto segments = follow(samples, 0.05);
  ASSERT_EQ(segments.size(), 1U);
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double change = range_at(samples[i], p_WT) - range_at(samples[0], p_WT);
    EXPECT_NEAR(segments[0].distance_m[i], change, 1e-9);
  }
}

TEST(PhaseFollowing, HoldsWhereDifferencesAreAmbiguous) {
  made::Noise noise;
  noise.phase_rad = 0.7;
  noise.range_sigma = 0.0;
  int slips_followed = 0;
  int slips_unwrapped = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    made::Rng rng(seed);
    const made::Path path = made::aisles(0.02);
    const Eigen::Vector3d p_WT = made::beside(path, 2.0, 0.4, rng);
    const auto samples = made::read_along(path, p_WT, noise, rng);
    for (const PhaseSegment& segment : follow(samples, 0.7)) {
      slips_followed += cycles_lost(segment, p_WT);
    }
    for (const PhaseSegment& segment : unwrap(samples, 0.8)) {
      slips_unwrapped += cycles_lost(segment, p_WT);
    }
  }
  EXPECT_GT(slips_unwrapped, 20);
  EXPECT_LT(4 * slips_followed, slips_unwrapped);
}

TEST(PhaseFollowing, BeginsAnewWhereTheTurnsAreNotSure) {
  made::Rng rng(3);
  made::Noise noise;
  noise.range_sigma = 0.0;
  auto samples =
      made::read_along(made::straight(4.0, 0.02), Eigen::Vector3d(2.0, 1.5, 0.4), noise, rng);
  samples.erase(samples.begin() + 60, samples.begin() + 140);  // 1.6 m without a read.
  EXPECT_EQ(follow(samples, 0.1).size(), 2U);
  for (std::size_t i = 30; i < samples.size(); ++i) samples[i].frequency_hz = 866.3e6;
  EXPECT_EQ(follow(samples, 0.1).size(), 3U);
}

TEST(PhaseFollowing, BridgesAFewLostReads) {
  made::Rng rng(4);
  made::Noise noise;
  noise.range_sigma = 0.0;
  auto samples =
      made::read_along(made::straight(4.0, 0.02), Eigen::Vector3d(2.0, 1.5, 0.4), noise, rng);
  // 14 cm, more than the 8.66 cm that unwrapping alone can bridge.
  samples.erase(samples.begin() + 60, samples.begin() + 66);
  const auto segments = follow(samples, 0.1);
  ASSERT_EQ(segments.size(), 1U);
  EXPECT_LT(greatest_slip(segments[0], {2.0, 1.5, 0.4}), 0.3);
}

/// Phases turned by at least a radian, one in twelve, among noise of 0.1 rad.
TEST(PhaseFollowing, FindsStrayPhasesAndHardlyAnyOther) {
  std::size_t strays = 0;
  std::size_t found = 0;
  std::size_t others = 0;
  std::size_t wrongly_found = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    made::Rng rng(seed);
    const made::Path path = made::s_curve(8.0, 0.03);
    const Eigen::Vector3d p_WT = made::beside(path, 2.0, 0.4, rng);
    auto samples = made::read_along(path, p_WT, made::Noise{}, rng);
    std::set<std::size_t> changed;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double turn = made::uniform(rng, 1.0, kTwoPi - 1.0);
      if (made::uniform(rng, 0.0, 1.0) > 1.0 / 12.0) continue;
      samples[i].phase_rad = wrap_to_two_pi(samples[i].phase_rad + turn);
      changed.insert(i);
    }
    const std::vector<std::size_t> flagged = stray_samples(samples, 0.1);
    EXPECT_TRUE(std::is_sorted(flagged.begin(), flagged.end()));
    const auto right = static_cast<std::size_t>(std::count_if(
        flagged.begin(), flagged.end(), [&](std::size_t i) { return changed.count(i) > 0; }));
    strays += changed.size();
    found += right;
    others += samples.size() - changed.size();
    wrongly_found += flagged.size() - right;
  }
  EXPECT_GT(5 * found, 4 * strays) << found << " of " << strays;
  EXPECT_LT(50 * wrongly_found, others) << wrongly_found << " of " << others;
}

TEST(PhaseFollowing, FindsNoStraysWhereThereAreNone) {
  std::size_t flagged = 0;
  std::size_t reads = 0;
  for (unsigned seed = 1; seed <= 20; ++seed) {
    made::Rng rng(seed);
    const made::Path path = made::aisles(0.03);
    const Eigen::Vector3d p_WT = made::beside(path, made::uniform(rng, 1.0, 3.0), 0.4, rng);
    const auto samples = made::read_along(path, p_WT, made::Noise{}, rng);
    flagged += stray_samples(samples, 0.1).size();
    reads += samples.size();
  }
  EXPECT_LT(1000 * flagged, reads) << flagged << " of " << reads;
}

}  // namespace
}  // namespace tagfield
