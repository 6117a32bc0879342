// SPDX-License-Identifier: Apache-2.0
/// @file
/// The sensors of a simulated robot while it drives: wheel encoders and laser.
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/laser/laser_scan.h"
#include "tagfield/laser/simulated_laser.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield {

/// The world as seen by lasers, shared by all runs in it.
struct LaserWorld {
  std::shared_ptr<const RayScene> rays;
  std::vector<ObstacleSpec> obstacles;  ///< In addition to the static world.
};

/// A scan with the odometry at its timestamp.
struct SensedScan {
  LaserScan scan;  ///< All of its beams are as of its timestamp.
  PlanarPose odometry;
};

/// Noisy wheel odometry and a laser on one robot, step by step. Frame O is that of the odometry:
/// the robot's pose at construction.
class RobotSenses {
 public:
  RobotSenses(const LaserWorld& world, const LaserParameters& laser, const OdometryNoise& noise,
              std::uint64_t seed, std::uint64_t key);

  /// The robot moves from `begin_W` at `now` with `velocity` for `seconds`. Returns the scans that
  /// end in this step.
  std::vector<SensedScan> step(const PlanarPose& begin_W, const BodyVelocity& velocity, Time now,
                               double seconds);

  /// X_OR by wheel odometry, `seconds` after the beginning of the current step.
  [[nodiscard]] PlanarPose odometry(double seconds) const;
  /// Length of the current step, 0 before the first.
  [[nodiscard]] double present_seconds() const {
    return motions_.empty() ? 0.0 : motions_.back().seconds;
  }

 private:
  /// One step's motion, kept for as long as a scan may need it.
  struct Motion {
    Time begin;
    double seconds = 0.0;
    PlanarPose begin_W;
    BodyVelocity velocity;
    PlanarPose begin_O;
    PlanarPose increment;  ///< By wheel odometry, over the whole step.
  };

  [[nodiscard]] const Motion& motion_at(Time stamp) const;
  [[nodiscard]] PlanarPose true_pose_at(Time stamp) const;
  [[nodiscard]] PlanarPose odometry_at(Time stamp) const;
  [[nodiscard]] SensedScan scan(std::int64_t number) const;

  LaserWorld world_;
  LaserParameters laser_;
  OdometryNoise noise_;
  std::uint64_t seed_;
  std::uint64_t key_;
  std::deque<Motion> motions_;  ///< The current one is last.
  std::uint64_t steps_ = 0;
  std::int64_t next_scan_ = 0;
};

}  // namespace tagfield
