// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/simulator/remote_driver.h"
#include "tagfield/simulator/self_driver.h"

namespace tagfield {

Robot::Robot(const RobotSpec& spec, const PoseBelief& belief, std::uint64_t seed)
    : spec_(spec),
      belief_(belief),
      seed_(seed),
      key_(stream_key(spec.name)),
      follower_(spec.start, spec.waypoints, spec.style),
      begin_(spec.start),
      odometry_(spec.start) {
  if (belief_.source == PoseSource::kNoisy) error_end_ = first_pose_error(belief_, seed_, key_);
}

Robot::Robot(const RobotSpec& spec, std::unique_ptr<SelfDriver> driver, std::uint64_t seed)
    : Robot(spec, PoseBelief{}, seed) {
  belief_.source = PoseSource::kSlam;
  self_driver_ = std::move(driver);
}

Robot::Robot(const RobotSpec& spec, std::unique_ptr<RemoteDriver> driver, std::uint64_t seed)
    : Robot(spec, PoseBelief{}, seed) {
  remote_driver_ = std::move(driver);
}

Robot::~Robot() = default;
Robot::Robot(Robot&&) noexcept = default;
Robot& Robot::operator=(Robot&&) noexcept = default;

bool Robot::finished() const {
  if (remote_driver_) return false;
  return self_driver_ ? self_driver_->finished() : follower_.finished();
}

double Robot::progress() const {
  if (finished()) return 1.0;
  if (self_driver_) return self_driver_->progress();
  if (remote_driver_) return 0.0;
  return std::min(travelled_m_ / std::max(planned_length(spec_), 1e-9), 1.0);
}

BodyVelocity Robot::wanted(Time now, double seconds) {
  if (remote_driver_) return remote_driver_->step(begin_, now, seconds);
  return self_driver_ ? self_driver_->step(begin_, now, seconds) : follower_.next(begin_, seconds);
}

void Robot::step(Time now, double seconds) {
  begin_ = advance(begin_, velocity_, step_seconds_);
  odometry_ = advance(odometry_, measured_, step_seconds_);
  error_begin_ = error_end_;
  step_seconds_ = seconds;
  while (times_kidnapped_ < spec_.kidnapped.size() &&
         spec_.kidnapped[times_kidnapped_].when <= now) {
    begin_ = spec_.kidnapped[times_kidnapped_++].to_W.value_or(begin_);
  }

  // Commands are executed by the wheels, the only actuators of a skid-steered robot.
  const WheelSpeeds wheels = wheel_speeds(spec_.drive, wanted(now, seconds));
  velocity_ = body_velocity(spec_.drive, wheels);
  travelled_m_ += std::abs(velocity_.forward) * seconds;
  if (belief_.source == PoseSource::kOdometry) {
    measured_ = body_velocity(spec_.drive, measured_wheel_speeds(belief_, spec_.drive, wheels,
                                                                 seconds, seed_, key_, steps_));
  }
  if (belief_.source == PoseSource::kNoisy) {
    error_end_ = next_pose_error(belief_, error_begin_, seconds, seed_, key_, steps_);
  }
  ++steps_;
}

RigidTransform Robot::true_pose(double seconds) const {
  return to_transform(advance(begin_, velocity_, seconds));
}

PoseError Robot::error_at(double seconds) const {
  const double fraction = seconds / step_seconds_;
  const auto between = [&](double from, double to) { return from + fraction * (to - from); };
  return {between(error_begin_.x, error_end_.x), between(error_begin_.y, error_end_.y),
          between(error_begin_.yaw, error_end_.yaw)};
}

RigidTransform Robot::believed_pose(double seconds) const {
  if (self_driver_) return to_transform(self_driver_->believed(seconds).pose_M);
  if (remote_driver_) {
    return to_transform(spec_.start) * to_transform(remote_driver_->odometry(seconds));
  }
  if (belief_.source == PoseSource::kOdometry) {
    return to_transform(advance(odometry_, measured_, seconds));
  }
  const PlanarPose pose = advance(begin_, velocity_, seconds);
  if (belief_.source == PoseSource::kTrue) return to_transform(pose);
  const PoseError error = error_at(seconds);
  return from_planar(pose.x + error.x, pose.y + error.y, pose.yaw + error.yaw);
}

}  // namespace tagfield
