// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that drives: its true pose and its believed pose.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>

#include "tagfield/base/time.h"
#include "tagfield/motion/path_follower.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/simulator/pose_error.h"

namespace tagfield {

class RemoteDriver;
class SelfDriver;

/// One robot, simulated step by step. Frame R is its base on the floor, x forward.
class Robot {
 public:
  Robot(const RobotSpec& spec, const PoseBelief& belief, std::uint64_t seed);
  /// A robot that navigates by itself, from spec.start on. Each of spec.kidnapped must have its
  /// `to_W`.
  Robot(const RobotSpec& spec, std::unique_ptr<SelfDriver> driver, std::uint64_t seed);
  /// A robot that is driven remotely and believes its wheel odometry. It never arrives.
  Robot(const RobotSpec& spec, std::unique_ptr<RemoteDriver> driver, std::uint64_t seed);
  ~Robot();
  Robot(Robot&&) noexcept;
  Robot& operator=(Robot&&) noexcept;

  /// Advances by one time step, which begins at `now`; true_pose and believed_pose then refer to
  /// that step.
  void step(Time now, double seconds);

  /// X_WR at `seconds` after the beginning of the current step, from 0 to its length.
  [[nodiscard]] RigidTransform true_pose(double seconds) const;
  [[nodiscard]] RigidTransform believed_pose(double seconds) const;

  [[nodiscard]] const std::string& name() const { return spec_.name; }
  /// Whether the robot has reached or given up its last waypoint or goal.
  [[nodiscard]] bool finished() const;
  /// Null if the robot does not navigate by itself.
  [[nodiscard]] const SelfDriver* self_driver() const { return self_driver_.get(); }
  /// Distance driven up to the end of the current step [m].
  [[nodiscard]] double travelled_m() const { return travelled_m_; }
  [[nodiscard]] std::size_t times_kidnapped() const { return times_kidnapped_; }
  /// Share of its path or of its goals that is done, 0 to 1.
  [[nodiscard]] double progress() const;

 private:
  [[nodiscard]] BodyVelocity wanted(Time now, double seconds);
  [[nodiscard]] PoseError error_at(double seconds) const;

  RobotSpec spec_;
  PoseBelief belief_;
  std::uint64_t seed_;
  std::uint64_t key_;
  PathFollower follower_;
  std::unique_ptr<SelfDriver> self_driver_;
  std::unique_ptr<RemoteDriver> remote_driver_;

  std::uint64_t steps_ = 0;
  double step_seconds_ = 0.0;
  double travelled_m_ = 0.0;
  std::size_t times_kidnapped_ = 0;
  PlanarPose begin_;       ///< True pose at the beginning of the step.
  BodyVelocity velocity_;  ///< During the step.
  PlanarPose odometry_;    ///< Dead-reckoned pose at the beginning of the step.
  BodyVelocity measured_;  ///< By wheel odometry during the step.
  PoseError error_begin_;  ///< Of a noisy belief at the beginning of the step,
  PoseError error_end_;    ///< and at its end.
};

}  // namespace tagfield
