// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/remote_driver.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/robot.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

constexpr double kStep_s = 0.01;

/// Commands one velocity until a time, then none, and keeps what it receives.
class Steady : public RemoteControl {
 public:
  Steady(const BodyVelocity& velocity, double until_s) : velocity_(velocity), until_s_(until_s) {}

  BodyVelocity wanted(Time now) override {
    return to_seconds(now) < until_s_ - 1e-9 ? velocity_ : BodyVelocity{};
  }
  void on_odometry(const OdometryReport& report) override { reports.push_back(report); }
  void on_scan(const LaserScan& scan) override { scans.push_back(scan); }

  std::vector<OdometryReport> reports;
  std::vector<LaserScan> scans;

 private:
  BodyVelocity velocity_;
  double until_s_;
};

Scenario scenario_of(double duration_s) {
  Scenario scenario;
  scenario.name = "driven";
  scenario.time_step_s = kStep_s;
  scenario.duration_s = duration_s;
  RobotSpec robot;
  robot.name = "cart";
  robot.start = {3.0, -2.0, M_PI / 2};
  scenario.robots.push_back(robot);
  own_navigation(scenario).odometry = {};
  NavigationSpec& navigation = own_navigation(scenario);
  navigation.odometry.alpha1 = navigation.odometry.alpha2 = 0.0;
  navigation.odometry.alpha3 = navigation.odometry.alpha4 = 0.0;
  navigation.driver.limits.speed_m_s = 1.0;
  navigation.driver.limits.acceleration_m_s2 = 0.5;
  return scenario;
}

RemoteDriving driving_by(const std::shared_ptr<RemoteControl>& control) {
  return {"cart", control, {std::make_shared<const RayScene>(Scene{}), {}}};
}

void run_to_end(Simulation& simulation) {
  while (!simulation.finished()) simulation.step();
}

TEST(RemoteDriver, DrivesAsFarAsItsLimitsLetIt) {
  const auto control = std::make_shared<Steady>(BodyVelocity{0.8, 0.0}, 5.0);
  const RemoteDriving driving = driving_by(control);
  Simulation simulation(scenario_of(10.0), 1, {}, nullptr, &driving);
  run_to_end(simulation);
  // Up to 0.8 m/s in 1.6 s, and down in the same time: v t, whatever the ramps. The first step of
  // each ramp is one step ahead of the straight line.
  const RigidTransform X_WB = simulation.robots().at(0).true_pose(0.0);
  EXPECT_NEAR(X_WB.translation.y(), -2.0 + 0.8 * 5.0, 1e-9);
  EXPECT_NEAR(X_WB.translation.x(), 3.0, 1e-9);
  double fastest = 0.0;
  for (const OdometryReport& report : control->reports) {
    fastest = std::max(fastest, report.velocity.forward);
  }
  EXPECT_NEAR(fastest, 0.8, 1e-12);
  EXPECT_NEAR(control->reports.at(100).velocity.forward, 0.5, 1e-9) << "after 1 s at 0.5 m/s2";
  EXPECT_EQ(control->reports.back().velocity.forward, 0.0);
}

TEST(RemoteDriver, NeverExceedsTheRobotsSpeed) {
  const auto control = std::make_shared<Steady>(BodyVelocity{50.0, 0.0}, 9.0);
  const RemoteDriving driving = driving_by(control);
  Simulation simulation(scenario_of(9.0), 1, {}, nullptr, &driving);
  run_to_end(simulation);
  for (const OdometryReport& report : control->reports) {
    EXPECT_LE(report.velocity.forward, 1.0 + 1e-12);
  }
}

TEST(RemoteDriver, OdometryBeginsWhereTheRobotStarts) {
  const auto control = std::make_shared<Steady>(BodyVelocity{0.5, 0.0}, 4.0);
  const RemoteDriving driving = driving_by(control);
  Simulation simulation(scenario_of(4.0), 1, {}, nullptr, &driving);
  run_to_end(simulation);
  EXPECT_EQ(control->reports.front().pose.x, 0.0);
  EXPECT_EQ(control->reports.front().pose.yaw, 0.0);
  // Without noise the odometry is true: forward is +x of O, which is +y of the world here.
  const Robot& robot = simulation.robots().at(0);
  EXPECT_NEAR(robot.believed_pose(0.0).translation.y(), robot.true_pose(0.0).translation.y(), 1e-9);
  EXPECT_NEAR(control->reports.back().pose.y, 0.0, 1e-9);
  EXPECT_GT(control->reports.back().pose.x, 1.0);
}

// 300 robots on a curve, with noise: errors normalized by the stated covariance follow χ² with 3
// degrees of freedom, and those of a velocity with one. Their means have standard deviations of
// √(2·3/300) = 0.14 and 0.08: the bounds are beyond 4 σ.
TEST(RemoteDriver, OdometryErrsAsItsCovarianceSays) {
  constexpr int kRobots = 300;
  double pose_sum = 0.0;
  double forward_sum = 0.0;
  double turn_sum = 0.0;
  for (int i = 0; i < kRobots; ++i) {
    const auto control = std::make_shared<Steady>(BodyVelocity{0.6, 0.4}, 100.0);
    const RemoteDriving driving = driving_by(control);
    Scenario scenario = scenario_of(6.0);
    own_navigation(scenario).odometry = {};
    Simulation simulation(scenario, 100 + static_cast<std::uint64_t>(i), {}, nullptr, &driving);
    run_to_end(simulation);
    const OdometryReport& reported = control->reports.back();
    const PlanarPose true_O =
        between(scenario.robots.at(0).start, planar(simulation.robots().at(0).true_pose(0.0)));
    const Eigen::Vector3d e(reported.pose.x - true_O.x, reported.pose.y - true_O.y,
                            wrap_to_pi(reported.pose.yaw - true_O.yaw));
    pose_sum += e.dot(reported.covariance.inverse() * e);
    const BodyVelocity& velocity = reported.velocity;
    forward_sum += std::pow(velocity.forward - 0.6, 2) / reported.velocity_variance.x();
    turn_sum += std::pow(velocity.turn - 0.4, 2) / reported.velocity_variance.y();
  }
  EXPECT_NEAR(pose_sum / kRobots, 3.0, 0.6);
  EXPECT_NEAR(forward_sum / kRobots, 1.0, 0.35);
  EXPECT_NEAR(turn_sum / kRobots, 1.0, 0.35);
}

TEST(RemoteDriver, ScansComeAtTheLasersRate) {
  const auto control = std::make_shared<Steady>(BodyVelocity{}, 0.0);
  const RemoteDriving driving = driving_by(control);
  Simulation simulation(scenario_of(2.0), 1, {}, nullptr, &driving);
  run_to_end(simulation);
  const LaserParameters laser;
  EXPECT_NEAR(static_cast<double>(control->scans.size()), 2.0 * laser.rate_hz, 1.0);
  EXPECT_EQ(beam_of(control->scans.at(0), control->scans.at(0).ranges_m.at(0)), Beam::kNothing);
}

TEST(RemoteDriver, NeedsTheRobot) {
  RemoteDriving driving = driving_by(std::make_shared<Steady>(BodyVelocity{}, 0.0));
  driving.robot = "cort";
  EXPECT_TRUE(contains(
      error_of([&] { const Simulation simulation(scenario_of(1.0), 1, {}, nullptr, &driving); }),
      "there is no robot 'cort' to be driven"));
}

}  // namespace
}  // namespace tagfield
