// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/odometry_drift.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "tagfield/motion/planar_pose.h"
#include "tagfield/scenario/navigation_spec.h"

namespace tagfield {
namespace {

/// Errors of a robot's wheel odometry; nullopt if it does not believe that.
std::optional<OdometryNoise> noise_of(const Scenario& scenario, const RobotSpec& robot) {
  if (pose_source_of(scenario, robot.name) != PoseSource::kOdometry) return std::nullopt;
  if (robot.name == scenario.driven_robot) return navigation_of(scenario).odometry;
  return noise_of_wheels(scenario.pose.wheel_noise, robot.drive);
}

std::vector<Drift> drift_along(const Trajectory& X_WA, const OdometryOfAntenna& carried) {
  const RigidTransform X_AP = carried.X_PA.inverse();
  std::vector<Drift> drift;
  drift.reserve(X_WA.size());
  PlanarPose last;
  for (const StampedPose& pose : X_WA) {
    const PlanarPose now = planar(pose.X_WB * X_AP);
    Drift next{pose.stamp, position_of(now)};
    if (!drift.empty()) {
      const PlanarPose step = between(last, now);
      const Eigen::Matrix3d none = Eigen::Matrix3d::Zero();
      next.since_start = propagated_covariance(drift.back().since_start, last, step, carried.noise);
      next.since_last = propagated_covariance(none, last, step, carried.noise);
    }
    drift.push_back(next);
    last = now;
  }
  return drift;
}

}  // namespace

OdometryNoise noise_of_wheels(double wheel_noise, const DriveGeometry& drive) {
  OdometryNoise noise;
  noise.alpha1 = wheel_noise / std::sqrt(drive.track_m);
  noise.alpha2 = wheel_noise * std::sqrt(2.0) / drive.track_m;
  noise.alpha3 = wheel_noise / std::sqrt(2.0);
  noise.alpha4 = 0.5 * wheel_noise * std::sqrt(drive.track_m);
  return noise;
}

OdometryByAntenna odometry_of(const Scenario& scenario) {
  OdometryByAntenna odometry;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const auto robot = std::find_if(scenario.robots.begin(), scenario.robots.end(),
                                    [&](const RobotSpec& spec) { return spec.name == antenna.on; });
    if (robot == scenario.robots.end()) continue;
    const std::optional<OdometryNoise> noise = noise_of(scenario, *robot);
    if (noise) odometry[antenna.parameters.name] = {antenna.X_PA, *noise};
  }
  return odometry;
}

DriftOf drift_by(OdometryByAntenna odometry) {
  if (odometry.empty()) return {};
  return [odometry = std::move(odometry)](const std::string& antenna, const Trajectory& X_WA) {
    const auto found = odometry.find(antenna);
    return found == odometry.end() ? std::vector<Drift>{} : drift_along(X_WA, found->second);
  };
}

DriftOf odometry_drift(const Scenario& scenario) { return drift_by(odometry_of(scenario)); }

}  // namespace tagfield
