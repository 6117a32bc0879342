// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/odometry_drift.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <memory>

#include "tagfield/base/test/error_text.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/simulator/remote_driver.h"

namespace tagfield {
namespace {

/// A robot that drives a U of 14 m by its wheels, past tags on both sides.
Scenario drive_by_wheels(double wheel_noise) {
  Scenario scenario;
  scenario.name = "by_wheels";
  scenario.pose.source = PoseSource::kOdometry;
  scenario.pose.wheel_noise = wheel_noise;
  RobotSpec robot;
  robot.name = "robot";
  robot.waypoints = {{6.0, 0.5}, {6.0, 3.0}, {0.0, 2.5}};
  scenario.robots = {robot};
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.on = "robot";
  antenna.X_PA = from_xyz_rpy({0.3, -0.1, 1.0}, {0.0, 0.0, 0.5});
  scenario.antennas = {antenna};
  const std::vector<Eigen::Vector3d> places = {
      {1.0, -1.5, 1.4}, {3.0, -2.0, 0.6}, {7.5, 1.0, 1.2}, {4.0, 1.4, 1.5}, {2.0, 4.5, 1.3}};
  for (std::size_t i = 0; i < places.size(); ++i) {
    TagSpec tag;
    tag.id = "tag" + std::to_string(i);
    tag.motion = {{Time{}, from_translation(places[i])}};
    scenario.tags.push_back(tag);
  }
  return scenario;
}

Trajectory trajectory_of(const std::vector<AntennaPose>& poses) {
  Trajectory trajectory;
  for (const AntennaPose& pose : poses) trajectory.push_back({pose.stamp, pose.X_WA});
  return trajectory;
}

/// Pose of the robot that carries the antenna.
PlanarPose robot_at(const Scenario& scenario, const AntennaPose& pose) {
  return planar(pose.X_WA * scenario.antennas.front().X_PA.inverse());
}

// The normalized squares of 400 final errors have the mean 3 within five standard deviations,
// √(6/400); the arcs of the turns overstate the variance by up to a tenth.
TEST(OdometryDrift, CoversWhereRobotsTrulyEnd) {
  const Scenario scenario = drive_by_wheels(0.003);
  const DriftOf drift_of = odometry_drift(scenario);
  constexpr int kRuns = 400;
  double sum = 0.0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const SeedRun run = simulate(scenario, static_cast<std::uint64_t>(seed), {}, nullptr);
    const std::vector<AntennaPose>& believed = run.recording.believed_poses;
    const Drift drift = drift_of("antenna", trajectory_of(believed)).back();
    const PlanarPose end = robot_at(scenario, believed.back());
    const PlanarPose truth = robot_at(scenario, run.recording.truth.antenna_poses.back());
    const Eigen::Vector3d error(end.x - truth.x, end.y - truth.y,
                                std::remainder(end.yaw - truth.yaw, 2.0 * kPi));
    EXPECT_LT((drift.origin_W - position_of(end)).norm(), 1e-9);
    sum += error.dot(drift.since_start.inverse() * error) / kRuns;
  }
  EXPECT_GT(sum, 3.0 * 0.9 - 5.0 * std::sqrt(6.0 / kRuns));
  EXPECT_LT(sum, 3.0 + 5.0 * std::sqrt(6.0 / kRuns));
}

/// Drives on an arc.
class Arc final : public RemoteControl {
 public:
  BodyVelocity wanted(Time) override { return {0.5, 0.1}; }
  void on_odometry(const OdometryReport&) override {}
  void on_scan(const LaserScan&) override {}
};

// The driven robot errs by navigation.odometry; 300 normalized squares, five standard deviations.
// Another robot keeps its pose source.
TEST(OdometryDrift, OfADrivenRobotIsThatOfItsNavigation) {
  Scenario scenario = drive_by_wheels(0.5);
  scenario.pose.source = PoseSource::kTrue;
  scenario.duration_s = 15.0;
  scenario.driven_robot = "robot";
  own_navigation(scenario).odometry = {0.03, 0.01, 0.02, 0.004};
  scenario.robots.push_back(scenario.robots.front());
  scenario.robots.back().name = "other";
  scenario.antennas.push_back(scenario.antennas.front());
  scenario.antennas.back().parameters.name = "of_other";
  scenario.antennas.back().on = "other";
  const RemoteDriving remote{
      "robot", std::make_shared<Arc>(), {std::make_shared<RayScene>(Scene{}), {}}};
  RunControl control;
  control.remote = &remote;
  const DriftOf drift_of = odometry_drift(scenario);
  constexpr int kRuns = 300;
  double sum = 0.0;
  for (int seed = 1; seed <= kRuns; ++seed) {
    const SeedRun run = simulate(scenario, static_cast<std::uint64_t>(seed), control, nullptr);
    Trajectory believed;
    std::map<std::string, PlanarPose> ends;
    std::map<std::string, PlanarPose> truths;
    for (const AntennaPose& pose : run.recording.believed_poses) {
      if (pose.antenna == "antenna") believed.push_back({pose.stamp, pose.X_WA});
      ends[pose.antenna] = robot_at(scenario, pose);
    }
    for (const AntennaPose& pose : run.recording.truth.antenna_poses) {
      truths[pose.antenna] = robot_at(scenario, pose);
    }
    const auto error_of = [&](const std::string& antenna) {
      const PlanarPose& end = ends.at(antenna);
      const PlanarPose& truth = truths.at(antenna);
      return Eigen::Vector3d(end.x - truth.x, end.y - truth.y,
                             std::remainder(end.yaw - truth.yaw, 2.0 * kPi));
    };
    const Eigen::Vector3d error = error_of("antenna");
    sum += error.dot(drift_of("antenna", believed).back().since_start.inverse() * error) / kRuns;
    EXPECT_EQ(error_of("of_other"), Eigen::Vector3d::Zero());
    EXPECT_TRUE(drift_of("of_other", believed).empty());
  }
  EXPECT_NEAR(sum, 3.0, 5.0 * std::sqrt(6.0 / kRuns));
}

struct Outcome {
  int located = 0;
  int far_off = 0;      ///< By over three expected errors.
  double mean_m = 0.0;  ///< Error of the located tags,
  double square = 0.0;  ///< and its mean square relative to the expected error.
};

Outcome outcome_of(const std::string& method, double wheel_noise, std::size_t runs) {
  Scenario scenario = drive_by_wheels(wheel_noise);
  scenario.localization.method = method;
  Outcome outcome;
  Diagnostics diagnostics;
  for (const SeedRun& run :
       run_seeds(scenario, 1, static_cast<std::size_t>(runs), {}, diagnostics)) {
    for (const TagOutcome& tag : run.outcomes) {
      const std::optional<double> error = error_of(tag);
      if (!error || tag.estimate.verdict != Verdict::kLocated) continue;
      const double ratio = *error / tag.estimate.candidates.front().expected_error_m;
      outcome.far_off += ratio > 3.0 ? 1 : 0;
      outcome.square += ratio * ratio;
      outcome.mean_m += *error;
      ++outcome.located;
    }
  }
  outcome.square /= outcome.located;
  outcome.mean_m /= outcome.located;
  return outcome;
}

// 150 errors, of which those of a run are correlated: as of some 60, the mean square is within four
// standard deviations 4 √(2/60) of 1.
TEST(OdometryDrift, IsInTheExpectedErrors) {
  for (const char* const method : {"hyperbola", "joint"}) {
    const Outcome outcome = outcome_of(method, 0.001, 30);
    EXPECT_GT(outcome.located, 130) << method;
    EXPECT_LT(outcome.square, 1.0 + 4.0 * std::sqrt(2.0 / 60.0)) << method;
    EXPECT_LE(outcome.far_off, 3) << method;
  }
}

// The tags together tell how the robot truly drove.
TEST(OdometryDrift, IsReducedByAllTagsTogether) {
  const Outcome together = outcome_of("joint", 0.003, 12);
  const Outcome singly = outcome_of("hyperbola", 0.003, 12);
  EXPECT_GT(together.located, 50);
  EXPECT_GT(together.located, singly.located);
  EXPECT_LT(together.mean_m, singly.mean_m);
}

// Wheels so bad that whole cycles are lost claim nothing, and no latency.
TEST(OdometryDrift, ThatIsTooLargeIsNoPosition) {
  Scenario scenario = drive_by_wheels(0.04);
  for (const char* const method : {"joint", "auto", "hyperbola"}) {
    scenario.localization.method = method;
    Diagnostics diagnostics;
    for (const SeedRun& run : run_seeds(scenario, 1, 4, {}, diagnostics)) {
      for (const TagOutcome& tag : run.outcomes) {
        EXPECT_NE(tag.estimate.verdict, Verdict::kLocated) << method << " " << tag.estimate.tag;
      }
    }
    for (const std::string& warning : diagnostics.warnings()) {
      EXPECT_FALSE(contains(warning, "stamped")) << warning;
    }
  }
}

TEST(OdometryDrift, OnlyPosesOfWheelsDrift) {
  Scenario scenario = drive_by_wheels(0.01);
  const Trajectory still = {{Time{}, RigidTransform{}}};
  EXPECT_EQ(odometry_drift(scenario)("antenna", still).size(), 1U);
  EXPECT_TRUE(odometry_drift(scenario)("another", still).empty());
  scenario.pose.source = PoseSource::kNoisy;
  EXPECT_FALSE(odometry_drift(scenario));
}

}  // namespace
}  // namespace tagfield
