/// @file
/// A robot that drives: where it is, and where it believes to be.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "simulator/pose_error.h"
#include "tagfield/base/error.h"
#include "tagfield/base/time.h"
#include "tagfield/motion/path_follower.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// A robot is picked up and put down elsewhere; its wheels don't notice.
struct Carrying {
  Time when;                       ///< Of the drive: mapping is over at 0.
  std::optional<PlanarPose> to_W;  ///< None: anywhere that it could have driven to.
  Location location;
};

struct RobotSpec {
  std::string name;
  PlanarPose start;
  DriveGeometry drive;
  DrivingStyle style;
  std::vector<Eigen::Vector2d> waypoints;  ///< [m, world]; none for a robot that stands.
  // For robots that find their way by themselves; at most one of waypoints, goals, random goals.
  std::vector<PlanarPose> goals_W;  ///< To be driven to, and to look along.
  int random_goals = 0;             ///< So many, drawn anew at each seed.
  std::vector<Carrying> carried;    ///< In order of time.
  Location location;                ///< Where it was written, for messages.
};

/// Whether it has anywhere to go.
inline bool drives(const RobotSpec& robot) {
  return !robot.waypoints.empty() || !robot.goals_W.empty() || robot.random_goals > 0;
}

/// Length of the robot's path over its waypoints or goals, corners not rounded [m].
double planned_length(const RobotSpec& robot);

class SelfDriver;

/// One robot during one time step after another. Frame R is its base on the floor, x forward.
class Robot {
 public:
  Robot(const RobotSpec& spec, const PoseBelief& belief, std::uint64_t seed);
  /// Finds its way by itself, from spec.start on. Each of spec.carried has its `to_W`.
  Robot(const RobotSpec& spec, std::unique_ptr<SelfDriver> driver, std::uint64_t seed);
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
  [[nodiscard]] PoseError error_at(double seconds) const;

  RobotSpec spec_;
  PoseBelief belief_;
  std::uint64_t seed_;
  std::uint64_t key_;
  PathFollower follower_;
  std::unique_ptr<SelfDriver> self_driver_;

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
