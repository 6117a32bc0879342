// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_jumps.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <random>

#include "survey_claims.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/localization/jumping_bodies.h"

namespace tagfield {
namespace {

/// A lap of 4 m by 3 m at `speed_m_s`, with corners on the spot, a stop, and `noise_m` of white
/// noise.
Trajectory lap(double rate_hz, double noise_m, double speed_m_s = 0.3) {
  std::mt19937 generator(7);
  std::normal_distribution<double> normal(0.0, 1.0);
  Trajectory track;
  const double stop_s = 6.0 / speed_m_s;
  for (int i = 0; i < static_cast<int>((15.0 / speed_m_s + 3.0) * rate_hz); ++i) {
    const double time_s = i / rate_hz;
    const double driven = speed_m_s * (time_s < stop_s ? time_s : std::max(stop_s, time_s - 3.0));
    const double x = std::min(driven, 4.0) - std::clamp(driven - 7.0, 0.0, 4.0);
    const double y = std::clamp(driven - 4.0, 0.0, 3.0) - std::clamp(driven - 11.0, 0.0, 3.0);
    track.push_back(
        {time_from_seconds(time_s), from_translation({x + noise_m * normal(generator),
                                                      y + noise_m * normal(generator), 1.0})});
  }
  return track;
}

Trajectory with_jump(Trajectory track, double at_s, const Eigen::Vector3d& by) {
  for (StampedPose& pose : track) {
    if (to_seconds(pose.stamp) > at_s) pose.X_WB.translation += by;
  }
  return track;
}

TEST(PoseJumps, AreFoundInAnyDirection) {
  for (int i = 0; i < 8; ++i) {
    const double angle = 0.25 * kPi * i;
    const Eigen::Vector3d by = 0.05 * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const auto jumps = pose_jumps(with_jump(lap(15.0, 0.0), 30.01, by));
    ASSERT_EQ(jumps.size(), 1U) << i;
    EXPECT_NEAR(jumps[0].size_m, 0.05, 1e-9);
    EXPECT_LT(to_seconds(jumps[0].from), 30.01);
    EXPECT_GT(to_seconds(jumps[0].to), 30.01);
  }
}

// A jump hardly longer than what is driven from pose to pose.
TEST(PoseJumps, AreFoundAtSpeed) {
  const auto jumps = pose_jumps(with_jump(lap(30.0, 0.0, 1.0), 4.51, {0.024, 0.032, 0.0}));
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_NEAR(jumps[0].size_m, 0.04, 1e-9);
}

TEST(PoseJumps, AreTheSameAmidNoiseOfThePoses) {
  const auto jumps = pose_jumps(with_jump(lap(15.0, 0.005), 30.01, {0.2, 0.0, 0.0}));
  ASSERT_EQ(jumps.size(), 1U);
  EXPECT_NEAR(jumps[0].size_m, 0.2, 0.05);
}

// Corners, a stop, few poses, and noise are none.
TEST(PoseJumps, AreNotWhatARobotDrives) {
  for (const double rate_hz : {0.5, 1.0, 2.0, 5.0, 15.0, 50.0}) {
    for (const double noise_m : {0.0, 0.002, 0.02}) {
      for (const double speed_m_s : {0.3, 1.0, 2.0}) {
        EXPECT_TRUE(pose_jumps(lap(rate_hz, noise_m, speed_m_s)).empty())
            << rate_hz << " " << noise_m << " " << speed_m_s;
      }
    }
  }
  EXPECT_TRUE(pose_jumps({}).empty());
}

// Where poses are given at stops only, every step is one.
TEST(PoseJumps, AreNotStepsFromStopToStop) {
  Trajectory track;
  for (int i = 0; i < 400; ++i) {
    track.push_back({time_from_seconds(0.1 * i), from_translation({0.1 * (i / 8), 0.0, 1.0})});
  }
  EXPECT_TRUE(pose_jumps(track).empty());
}

TEST(PoseJumps, AreReportedOnceForARobot) {
  const Trajectory track =
      with_jump(with_jump(lap(15.0, 0.0), 12.01, {0.1, 0.0, 0.0}), 40.01, {0.0, -0.3, 0.0});
  Diagnostics diagnostics;
  warn_of_pose_jumps({{"left", {track, {}}}, {"right", {track, {}}}}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_TRUE(
      contains(diagnostics.warnings()[0], "'left' jump 2 times, at most by 0.30 m, from 40.0"))
      << diagnostics.warnings()[0];
}

PhaseSample sample_at(double time_s) {
  PhaseSample sample;
  sample.stamp = time_from_seconds(time_s);
  return sample;
}

PoseJump jump_between(double from_s, double to_s, double size_m) {
  return {time_from_seconds(from_s), time_from_seconds(to_s), size_m, Eigen::Vector2d::Zero(),
          false};
}

// A tag keeps the reads on the side where most are; the frame is that of all reads.
TEST(PoseJumps, LeaveATagTheReadsOnOneSide) {
  SamplesByTag samples;
  for (int i = 0; i < 6; ++i) samples["early"]["a"].push_back(sample_at(i));
  samples["both"]["a"] = {sample_at(8.0), sample_at(9.0), sample_at(10.05), sample_at(11.0)};
  samples["both"]["b"] = {sample_at(12.0), sample_at(13.0)};
  samples["both"]["fixed"] = {sample_at(1.0), sample_at(10.05), sample_at(19.0)};
  samples["amid"]["a"] = {sample_at(10.05)};
  std::vector<JumpingBody> bodies = {{{"a", "b"}, {jump_between(10.0, 10.1, 0.2)}}};
  const auto deviations = keep_one_side(bodies, samples);
  EXPECT_EQ(samples["early"]["a"].size(), 6U);
  ASSERT_EQ(samples["both"]["a"].size(), 1U);
  EXPECT_EQ(samples["both"]["a"][0].stamp, time_from_seconds(11.0));
  EXPECT_EQ(samples["both"]["b"].size(), 2U);
  EXPECT_EQ(samples["both"]["fixed"].size(), 3U);
  EXPECT_TRUE(samples["amid"].empty());
  // Of 11 reads that are not amid the jump 8 are before it.
  EXPECT_NEAR(deviations.at("early"), 0.2 * std::sqrt(6.0 / 11.0), 1e-12);
  EXPECT_NEAR(deviations.at("both"), 0.2, 1e-12);
  EXPECT_EQ(deviations.count("amid"), 0U);
}

// So far off it can't have been: only what comes after counts, and nothing is added to it.
TEST(PoseJumps, BeyondWhatWasDrivenLeaveTheReadsAfterThem) {
  const auto jumps = pose_jumps(
      with_jump(with_jump(lap(15.0, 0.0), 2.01, {5.0, 0.0, 0.0}), 30.01, {0.0, 0.3, 0.0}));
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_TRUE(jumps[0].is_relocation);
  EXPECT_FALSE(jumps[1].is_relocation);
  SamplesByTag samples;
  for (int i = 0; i < 30; ++i) samples["both"]["a"].push_back(sample_at(0.1 * i));
  samples["early"]["a"] = {sample_at(1.0)};
  samples["late"]["a"] = {sample_at(3.0), sample_at(40.0), sample_at(41.0)};
  std::vector<JumpingBody> bodies = {{{"a"}, {jumps[0]}}};
  SamplesByTag of_first = samples;
  const auto deviations = keep_one_side(bodies, of_first);
  EXPECT_EQ(of_first["both"]["a"].size(), 9U);
  EXPECT_EQ(deviations.count("both"), 0U);
  EXPECT_NEAR(deviations.at("early"), 5.0, 1e-9);
  bodies = {{{"a"}, jumps}};
  SamplesByTag of_both = samples;
  const auto by_both = keep_one_side(bodies, of_both);
  EXPECT_EQ(of_both["late"]["a"].size(), 2U);
  EXPECT_NEAR(by_both.at("late"), 0.3, 1e-9);  // 2 of the 12 reads after the first jump.
  EXPECT_NEAR(by_both.at("both"), 0.3 * std::sqrt(2.0 * 2.0 / 12.0), 1e-9);
  EXPECT_EQ(bodies[0].jumps.size(), 2U);
}

TEST(PoseJumps, BeforeTheFirstReadOrAfterTheLastHaveNoEffect) {
  SamplesByTag samples;
  for (int i = 5; i < 9; ++i) samples["tag"]["a"].push_back(sample_at(i));
  std::vector<JumpingBody> bodies = {
      {{"a"}, {jump_between(1.0, 1.1, 0.5), jump_between(20.0, 20.1, 0.5)}}};
  EXPECT_TRUE(keep_one_side(bodies, samples).empty());
  EXPECT_TRUE(bodies.empty());
  EXPECT_EQ(samples["tag"]["a"].size(), 4U);
}

// Against counting by hand.
RC_GTEST_PROP(PoseJumps, LeaveTheReadsBetweenTwoOfThem, ()) {
  const auto times = *rc::gen::container<std::vector<int>>(12, rc::gen::inRange(0, 50));
  const auto starts = *rc::gen::unique<std::vector<int>>(3, rc::gen::inRange(0, 50));
  std::vector<int> sorted = starts;
  std::sort(sorted.begin(), sorted.end());
  SamplesByTag samples;
  // Stamps are whole seconds and a half, jumps from a whole second to the next.
  for (const int t : times) samples["tag"]["a"].push_back(sample_at(t + 0.25 * (t % 3)));
  std::vector<JumpingBody> bodies = {{{"a"}, {}}};
  for (const int s : sorted) bodies[0].jumps.push_back(jump_between(s, s + 0.3, 0.1));
  std::map<int, std::vector<Time>> of_side;
  for (const PhaseSample& sample : samples["tag"]["a"]) {
    int side = 0;
    bool amid = false;
    for (const PoseJump& jump : bodies[0].jumps) {
      if (jump.to <= sample.stamp) ++side;
      amid = amid || (jump.from < sample.stamp && sample.stamp < jump.to);
    }
    if (!amid) of_side[side].push_back(sample.stamp);
  }
  std::size_t most = 0;
  for (const auto& [side, stamps] : of_side) most = std::max(most, stamps.size());
  const auto deviations = keep_one_side(bodies, samples);
  if (of_side.size() < 2) {  // No jump has reads on both sides.
    RC_ASSERT(deviations.empty());
    return;
  }
  std::vector<Time> left;
  for (const PhaseSample& sample : samples["tag"]["a"]) left.push_back(sample.stamp);
  RC_ASSERT(left.size() == most);
  RC_ASSERT(std::any_of(of_side.begin(), of_side.end(),
                        [&](const auto& entry) { return entry.second == left; }));
  std::size_t count = 0;
  for (const auto& [side, stamps] : of_side) count += stamps.size();
  const double share = static_cast<double>(most) / static_cast<double>(count);
  const double expected_m = share > 0.5 ? 0.1 * std::sqrt(2.0 * (1.0 - share)) : 0.1;
  RC_ASSERT(std::abs(deviations.at("tag") - expected_m) < 1e-12);
}

/// Surveys whose believed poses jump once in the middle third, in any direction.
made::Claims claims_with_jumps(const std::string& method, double size_m) {
  made::Claims claims;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    made::Rng rng(seed);
    made::SurveyPlan plan;
    plan.tags = 5;
    plan.pose_m = 0.005;
    made::Survey survey = made::make_survey(plan, rng);
    survey.known.limits.max_expected_error_m = 2.0 * size_m + 0.1;
    const std::size_t at = static_cast<std::size_t>(made::uniform(rng, 0.33, 0.67) *
                                                    static_cast<double>(survey.poses.size()));
    const double direction = made::uniform(rng, 0.0, kTwoPi);
    const Eigen::Vector3d by(size_m * std::cos(direction), size_m * std::sin(direction), 0.0);
    for (std::size_t i = at; i < survey.poses.size(); ++i) {
      survey.poses[i].X_WA.translation += by;
    }
    add_claims(method, survey, claims);
  }
  return claims;
}

TEST(PoseJumps, AreInTheExpectedErrors) {
  for (const std::string method : {"auto", "hyperbola", "joint", "sar"}) {
    for (const double size_m : {0.05, 0.1, 0.3}) {
      const made::Claims claims = claims_with_jumps(method, size_m);
      fmt::print(
          "{} with jumps of {} m: {} of {} located, {} falsely; error/expected {:.2f}, at most "
          "{:.1f}\n",
          method, size_m, claims.located, claims.tags, claims.false_ones, claims.calibration(),
          claims.worst);
      EXPECT_GE(2 * claims.located, claims.tags) << method << " " << size_m;
      EXPECT_LE(claims.calibration(), 1.3) << method << " " << size_m;
      EXPECT_EQ(claims.false_ones, 0) << method << " " << size_m;
    }
  }
}

}  // namespace
}  // namespace tagfield
