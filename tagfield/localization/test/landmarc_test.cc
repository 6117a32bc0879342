// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/landmarc.h"

#include <gtest/gtest.h>

#include "method_study.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using namespace made;

/// Four antennas in the corners of a room of 6 m by 6 m read all tags.
SamplesOfTag read_in_room(const Eigen::Vector3d& p_WT, double noise_db, Rng& rng) {
  SamplesOfTag samples;
  for (int corner = 0; corner < 4; ++corner) {
    const Eigen::Vector3d p_WA(6.0 * (corner % 2), 6.0 * (corner / 2), 2.0);
    for (int i = 0; i < 20; ++i) {
      PhaseSample sample;
      sample.stamp = time_from_seconds(1.7e9 + 0.05 * i);
      sample.frequency_hz = 865.7e6;
      sample.p_WA = p_WA;
      sample.rssi_dbm =
          std::round(-30.0 - 40.0 * std::log10((p_WT - p_WA).norm()) + normal(rng, noise_db));
      samples["corner" + std::to_string(corner)].push_back(sample);
    }
  }
  return samples;
}

LocalizationProblem room_with_references(Rng& rng, double spacing = 1.0) {
  LocalizationProblem problem;
  for (double x = 1.0; x <= 5.0; x += spacing) {
    for (double y = 1.0; y <= 5.0; y += spacing) {
      const std::string tag = "r" + std::to_string(problem.reference_tags.size());
      problem.reference_tags[tag] = {x, y, 1.0};
      problem.samples[tag] = read_in_room({x, y, 1.0}, 1.0, rng);
    }
  }
  return problem;
}

TEST(Landmarc, LocatesBetweenItsNeighbours) {
  Rng rng(1);
  Tally tally;
  for (int i = 0; i < 20; ++i) {
    LocalizationProblem problem = room_with_references(rng);
    const Eigen::Vector3d p_WT{uniform(rng, 1.5, 4.5), uniform(rng, 1.5, 4.5), 1.0};
    problem.samples["a tag"] = read_in_room(p_WT, 1.0, rng);
    tally.add(locate_one(landmarc_method({}), problem), p_WT);  // The first in ascending order.
  }
  tally.finish();
  EXPECT_EQ(tally.errors.size(), 20u);
  EXPECT_LT(tally.mean(), 0.6);
  EXPECT_LT(tally.errors.back(), 1.5);
}

/// By hand: signal distances of 1, 2 and 3 dB give weights in the ratio 36 : 9 : 4.
TEST(Landmarc, WeightsAreTheInverseSquares) {
  const auto with_rssi = [](double rssi_dbm) {
    PhaseSample sample;
    sample.frequency_hz = 865.7e6;
    sample.p_WA = Eigen::Vector3d::Zero();
    sample.rssi_dbm = rssi_dbm;
    return SamplesOfTag{{"a", {sample}}};
  };
  LocalizationProblem problem;
  problem.samples = {{"r1", with_rssi(-51.0)},  {"r2", with_rssi(-52.0)},
                     {"r3", with_rssi(-53.0)},  {"r4", with_rssi(-70.0)},
                     {"r5", with_rssi(-85.0)},  {"r6", with_rssi(-100.0)},
                     {"r7", with_rssi(-115.0)}, {"a tag", with_rssi(-50.0)}};
  problem.reference_tags = {
      {"r1", {1.0, 0.0, 0.5}}, {"r2", {0.0, 1.0, 0.5}}, {"r3", {0.0, 0.0, 0.5}}, {"r4", {9, 9, 9}},
      {"r5", {18, 18, 9}},     {"r6", {27, 27, 9}},     {"r7", {36, 36, 9}}};
  LandmarcOptions options;
  options.neighbours = 3;
  const TagEstimate estimate = locate_one(landmarc_method(options), problem);
  ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
  const Eigen::Vector3d& p_WT = estimate.candidates[0].p_WT;
  EXPECT_NEAR(p_WT.x(), 36.0 / 49.0, 1e-9);
  EXPECT_NEAR(p_WT.y(), 9.0 / 49.0, 1e-9);
  EXPECT_NEAR(p_WT.z(), 0.5, 1e-9);
}

TEST(Landmarc, WithoutReferenceTagsItSaysSo) {
  Rng rng(2);
  LocalizationProblem problem;
  problem.samples["a tag"] = read_in_room({2.0, 2.0, 1.0}, 1.0, rng);
  EXPECT_EQ(locate_one(landmarc_method({}), problem).reason,
            "cannot localize: needs reference tags: 0 were read with RSSI, at least 5 are needed");
}

TEST(Landmarc, StrengthsThatDoNotGoByPlaceLocateNothing) {
  Rng rng(4);
  int located = 0;
  for (int i = 0; i < 100; ++i) {
    LocalizationProblem problem = room_with_references(rng, 2.0);
    problem.samples["a tag"] = read_in_room({2.0, 2.0, 1.0}, 1.0, rng);
    for (auto& [tag, samples] : problem.samples) {
      for (auto& [antenna, series] : samples) {
        const double rssi = uniform(rng, -75.0, -35.0);
        for (PhaseSample& sample : series) sample.rssi_dbm = rssi;
      }
    }
    if (locate_one(landmarc_method({}), problem).verdict == Verdict::kLocated) ++located;
  }
  // One in a hundred by chance; in a Poisson distribution more than 5 have a probability of 6 in
  // 10⁴.
  EXPECT_LE(located, 5);
}

TEST(Landmarc, ReadsWithoutRssiAreNotCounted) {
  Rng rng(3);
  LocalizationProblem problem = room_with_references(rng, 2.0);
  problem.samples["a tag"] = read_in_room({2.0, 2.0, 1.0}, 1.0, rng);
  for (auto& [antenna, series] : problem.samples["a tag"]) {
    for (PhaseSample& sample : series) sample.rssi_dbm = kNoRssi;
  }
  EXPECT_EQ(locate_one(landmarc_method({}), problem).reason,
            "cannot localize: no read has an RSSI");
}

TEST(Landmarc, BadOptionsAreErrors) {
  LandmarcOptions options;
  options.neighbours = 0;
  EXPECT_THROW(landmarc_method(options), Error);
  options = {};
  options.bin_s = 0.0;
  EXPECT_THROW(landmarc_method(options), Error);
}

}  // namespace
}  // namespace tagfield
