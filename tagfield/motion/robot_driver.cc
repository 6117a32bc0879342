// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/robot_driver.h"

#include <cmath>

namespace tagfield {

bool RobotDriver::command(const BodyVelocity& velocity, Time now) {
  if (!std::isfinite(velocity.forward) || !std::isfinite(velocity.turn)) return false;
  command_ = Command{velocity, now};
  return true;
}

BodyVelocity RobotDriver::wanted(const PlanarPose& pose, Time now) {
  if (command_ && now - command_->given < settings_.command_timeout) {
    steered_.reset();
    return command_->velocity;
  }
  command_.reset();
  if (!path_) return {};
  if (!steered_ || now - *steered_ >= settings_.steering_interval) {
    steering_ = path_->next(pose, to_seconds(settings_.steering_interval));
    steered_ = now;
  }
  return steering_;
}

BodyVelocity RobotDriver::next(const PlanarPose& pose, Time now) {
  const double seconds = last_ ? to_seconds(now - *last_) : 0.0;
  last_ = now;
  velocity_ = limited(wanted(pose, now), velocity_, settings_.limits, seconds);
  return velocity_;
}

}  // namespace tagfield
