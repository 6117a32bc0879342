// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/remote_driver.h"

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {

RemoteDriver::RemoteDriver(const RemoteDriving& driving, const NavigationSpec& navigation,
                           std::uint64_t seed, std::uint64_t key)
    : control_(driving.control),
      limits_(navigation.driver.limits),
      noise_(navigation.odometry),
      senses_(driving.world, navigation.laser, navigation.odometry, seed, key) {}

BodyVelocity RemoteDriver::step(const PlanarPose& begin_W, Time now, double seconds) {
  last_ = report(now);
  velocity_ = limited(control_->wanted(now), velocity_, limits_, seconds);
  control_->on_odometry(last_);
  for (const SensedScan& sensed : senses_.step(begin_W, velocity_, now, seconds)) {
    control_->on_scan(sensed.scan);
  }
  return velocity_;
}

/// Pose and velocity are those of the wheel odometry. Their variances are computed from the true
/// motion: over one step the wheels' noise would look like turning and make them too large.
OdometryReport RemoteDriver::report(Time now) {
  const double seconds = senses_.present_seconds();
  OdometryReport report;
  report.stamp = now;
  report.pose = senses_.odometry(seconds);
  if (seconds <= 0.0) return report;
  const PlanarPose moved = between(last_.pose, report.pose);
  const PlanarPose driven = advance({}, velocity_, seconds);
  report.covariance = propagated_covariance(last_.covariance, last_.pose, driven, noise_);
  const double forward = moved.x * cosine(0.5 * moved.yaw) + moved.y * sine(0.5 * moved.yaw);
  report.velocity = {forward / seconds, moved.yaw / seconds};
  report.velocity_variance = increment_variances(driven, noise_) / (seconds * seconds);
  return report;
}

}  // namespace tagfield
