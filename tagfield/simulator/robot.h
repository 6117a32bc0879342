// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that drives: where it is, and where it believes to be.
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

/// One robot during one time step after another. Frame R is its base on the floor, x forward.
class Robot {
 public:
  Robot(const RobotSpec& spec, const PoseBelief& belief, std::uint64_t seed);
  /// Finds its way by itself, from spec.start on. Each of spec.carried has its `to_W`.
  Robot(const RobotSpec& spec, std::unique_ptr<SelfDriver> driver, std::uint64_t seed);
  /// Is driven by somebody outside, and believes its wheels. Never arrives.
  Robot(const RobotSpec& spec, std::unique_ptr<RemoteDriver> driver, std::uint64_t seed);
  ~Robot();
  Robot(Robot&&) noexcept;
  Robot& operator=(Robot&&) noexcept;

  /// Goes one time step on, which begins at `now`; true_pose and believed_pose then speak of that
  /// step.
  void step(Time now, double seconds);

  /// X_WR at `seconds` after the current step's beginning, between 0 and its length.
  [[nodiscard]] RigidTransform true_pose(double seconds) const;
  [[nodiscard]] RigidTransform believed_pose(double seconds) const;

  [[nodiscard]] const std::string& name() const { return spec_.name; }
  /// Whether it stands at its last waypoint, or has given it up.
  [[nodiscard]] bool finished() const;
  /// None where it follows its waypoints with its eyes shut.
  [[nodiscard]] const SelfDriver* self_driver() const { return self_driver_.get(); }
  /// Way driven up to the current step's end [m].
  [[nodiscard]] double travelled_m() const { return travelled_m_; }
  [[nodiscard]] std::size_t times_carried() const { return times_carried_; }
  /// Share of its way or of its goals that is behind it, 0 to 1.
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
  std::size_t times_carried_ = 0;
  PlanarPose begin_;       ///< True pose as the step begins.
  BodyVelocity velocity_;  ///< During the step.
  PlanarPose odometry_;    ///< Dead-reckoned pose as the step begins.
  BodyVelocity measured_;  ///< By the wheels during the step.
  PoseError error_begin_;  ///< Of a noisy belief as the step begins,
  PoseError error_end_;    ///< and as it ends.
};

}  // namespace tagfield
