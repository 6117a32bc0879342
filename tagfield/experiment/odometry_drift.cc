// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/odometry_drift.h"

#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// An antenna on a robot.
struct Carried {
  RigidTransform X_AP;  ///< The robot in the antenna's frame.
  OdometryNoise noise;
};

std::map<std::string, Carried> antennas_on_robots(const Scenario& scenario) {
  std::map<std::string, Carried> carried;
  for (const AntennaSpec& antenna : scenario.antennas) {
    const auto robot = std::find_if(scenario.robots.begin(), scenario.robots.end(),
                                    [&](const RobotSpec& spec) { return spec.name == antenna.on; });
    if (robot == scenario.robots.end()) continue;
    carried[antenna.parameters.name] = {antenna.X_PA.inverse(),
                                        noise_of_wheels(scenario.pose.wheel_noise, robot->drive)};
  }
  return carried;
}

std::vector<Drift> drift_along(const Trajectory& X_WA, const Carried& carried) {
  std::vector<Drift> drift;
  drift.reserve(X_WA.size());
  PlanarPose last;
  for (const StampedPose& pose : X_WA) {
    const PlanarPose now = planar(pose.X_WB * carried.X_AP);
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

DriftOf odometry_drift(const Scenario& scenario) {
  if (scenario.pose.source != PoseSource::kOdometry) return {};
  return
      [carried = antennas_on_robots(scenario)](const std::string& antenna, const Trajectory& X_WA) {
        const auto found = carried.find(antenna);
        return found == carried.end() ? std::vector<Drift>{} : drift_along(X_WA, found->second);
      };
}

}  // namespace tagfield
