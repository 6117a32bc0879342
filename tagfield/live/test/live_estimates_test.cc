// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/live_estimates.h"

#include <gtest/gtest.h>

#include <cmath>
#include <thread>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kFrequency_hz = 866e6;
const Eigen::Vector3d kTag(2.0, 1.8, 1.0);

AntennaInfo antenna_info() {
  AntennaInfo antenna;
  antenna.name = "mobile";
  antenna.reader = "reader";
  return antenna;
}

/// Along x for 4 m, then along y, at 0.5 m/s.
Eigen::Vector3d place_at(double seconds) {
  const double way = 0.5 * seconds;
  return way < 4.0 ? Eigen::Vector3d(way, 0.0, 1.0) : Eigen::Vector3d(4.0, way - 4.0, 1.0);
}

/// φ = 4π r/λ + offset, with noise of 0.1 rad.
TagRead read_from(double seconds, const Eigen::Vector3d& p_WT, int number) {
  const double r = (p_WT - place_at(seconds)).norm();
  const double noise = 0.1 * std::sin(12.9898 * number) * std::sqrt(2.0);
  const double phase = 4.0 * kPi * r * kFrequency_hz / kSpeedOfLight + 0.7 + noise;
  return {time_from_seconds(seconds),
          "reader",
          "mobile",
          "tag",
          kFrequency_hz,
          phase - 2.0 * kPi * std::floor(phase / (2.0 * kPi)),
          -50.0 - 40.0 * std::log10(r)};
}

struct Drive {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
};

Drive drive(double from_s, double to_s, const Eigen::Vector3d& p_WT = kTag) {
  Drive all;
  const int first = static_cast<int>(std::lround(20.0 * from_s));
  const int last = static_cast<int>(std::lround(20.0 * to_s));
  for (int i = first; i < last; ++i) {
    all.poses.push_back(
        {time_from_seconds(i / 20.0), "mobile", from_translation(place_at(i / 20.0))});
    all.reads.push_back(read_from(i / 20.0, p_WT, i));
  }
  return all;
}

void tell(LiveEstimates& estimates, const Drive& drive) {
  for (std::size_t i = 0; i < drive.reads.size(); ++i) {
    estimates.on_pose(antenna_info(), drive.poses[i]);
    estimates.on_read(drive.reads[i]);
  }
}

void wait_until_idle(const LiveEstimates& estimates) {
  while (!estimates.is_idle()) std::this_thread::sleep_for(std::chrono::milliseconds(5));
}

LiveEstimateOptions by(const std::string& method) {
  LiveEstimateOptions options;
  options.localization.method = method;
  options.localization.known.pose_error = PoseErrorModel{};
  return options;
}

TEST(LiveEstimates, PlaceAndCertaintyGrowWithTheWay) {
  LiveEstimates estimates(by("ml"));
  tell(estimates, drive(0.0, 7.5));  // Straight: two positions are equally good.
  wait_until_idle(estimates);
  ASSERT_EQ(estimates.since(0).size(), 1U);
  EXPECT_NE(estimates.since(0)[0].estimate.verdict, Verdict::kLocated);

  tell(estimates, drive(7.5, 9.5));
  wait_until_idle(estimates);
  const LiveEstimate early = estimates.since(0).at(0);
  ASSERT_EQ(early.estimate.verdict, Verdict::kLocated) << early.estimate.reason;

  const std::uint64_t seen = estimates.newest();
  tell(estimates, drive(9.5, 16.0));
  wait_until_idle(estimates);
  ASSERT_EQ(estimates.since(seen).size(), 1U);
  const LiveEstimate late = estimates.since(seen).at(0);
  ASSERT_EQ(late.estimate.verdict, Verdict::kLocated);
  EXPECT_EQ(late.estimate.tag, "tag");
  EXPECT_EQ(late.method, "ml");
  EXPECT_LT((late.estimate.candidates[0].p_WT - kTag).head<2>().norm(), 0.02);
  EXPECT_LT(late.estimate.candidates[0].expected_error_m,
            0.8 * early.estimate.candidates[0].expected_error_m);
  EXPECT_GT(late.last_read, time_from_seconds(14.0));
}

TEST(LiveEstimates, AreWhatTheWindowsReadsSay) {
  const Drive all = drive(0.0, 16.0);
  LiveEstimates estimates(by("hyperbola"));
  tell(estimates, all);
  wait_until_idle(estimates);
  const LiveEstimate live = estimates.since(0).at(0);
  Drive used = all;
  while (used.reads.back().stamp > live.last_read) used.reads.pop_back();
  Diagnostics unheard;
  const LocalizationResult offline =
      locate_tags(used.reads, all.poses, by("hyperbola").localization, unheard);
  ASSERT_EQ(offline.estimates.size(), 1U);
  EXPECT_EQ(live.estimate.verdict, offline.estimates[0].verdict);
  ASSERT_FALSE(live.estimate.candidates.empty());
  // Poses sent after the last read may or may not have been included.
  EXPECT_NEAR((live.estimate.candidates[0].p_WT - offline.estimates[0].candidates[0].p_WT).norm(),
              0.0, 1e-6);
}

TEST(LiveEstimates, ATagThatWasCarriedElsewhereIsFoundAgain) {
  LiveEstimateOptions options = by("ml");
  options.window = std::chrono::seconds(16);
  LiveEstimates estimates(options);
  tell(estimates, drive(0.0, 16.0));
  Drive later = drive(0.0, 16.0, {1.0, 2.2, 1.0});
  for (TagRead& read : later.reads) read.stamp += std::chrono::seconds(17);
  for (AntennaPose& pose : later.poses) pose.stamp += std::chrono::seconds(17);
  tell(estimates, later);
  wait_until_idle(estimates);
  const LiveEstimate now = estimates.since(0).at(0);
  ASSERT_EQ(now.estimate.verdict, Verdict::kLocated) << now.estimate.reason;
  EXPECT_LT((now.estimate.candidates[0].p_WT - Eigen::Vector3d(1.0, 2.2, 1.0)).head<2>().norm(),
            0.02);
}

TEST(LiveEstimates, AnotherRunBeginsWithNothing) {
  LiveEstimates estimates(by("ml"));
  tell(estimates, drive(0.0, 16.0));
  wait_until_idle(estimates);
  ASSERT_EQ(estimates.since(0).size(), 1U);
  estimates.on_restart();
  EXPECT_TRUE(estimates.since(0).empty());
  EXPECT_TRUE(estimates.stop(std::chrono::seconds(30)));
}

TEST(LiveEstimates, WrongOptionsAreRefusedAtOnce) {
  EXPECT_THROW(LiveEstimates(by("guess")), Error);
}

}  // namespace
}  // namespace tagfield
