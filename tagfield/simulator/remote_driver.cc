// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/remote_driver.h"

namespace tagfield {

RemoteDriver::RemoteDriver(const RemoteDriving& driving, const NavigationSpec& navigation,
                           std::uint64_t seed, std::uint64_t key)
    : control_(driving.control),
      limits_(navigation.driver.limits),
      senses_(driving.world, navigation.laser, navigation.odometry, seed, key) {}

BodyVelocity RemoteDriver::step(const PlanarPose& begin_W, Time now, double seconds) {
  const PlanarPose odometry_O = senses_.odometry(senses_.present_seconds());
  velocity_ = limited(control_->wanted(now), velocity_, limits_, seconds);
  control_->on_odometry(now, odometry_O, velocity_);
  for (const SensedScan& sensed : senses_.step(begin_W, velocity_, now, seconds)) {
    control_->on_scan(sensed.scan);
  }
  return velocity_;
}

}  // namespace tagfield
