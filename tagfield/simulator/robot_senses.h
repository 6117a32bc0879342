// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a simulated robot senses while it drives: its wheels and its laser.
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

/// The world as lasers see it, shared by all runs in it.
struct LaserWorld {
  std::shared_ptr<const RayScene> rays;
  std::vector<ObstacleSpec> obstacles;  ///< Besides the world at rest.
};

/// A scan with what the wheels told at its stamp.
struct SensedScan {
  LaserScan scan;  ///< All of its beams as of one moment, its stamp.
  PlanarPose odometry;
};

/// Wheel odometry with noise and a laser on one robot, step after step. Frame O is the odometry's:
/// where the robot was when this was made.
class RobotSenses {
 public:
  RobotSenses(const LaserWorld& world, const LaserParameters& laser, const OdometryNoise& noise,
              std::uint64_t seed, std::uint64_t key);

  /// The robot moves from `begin_W` at `now` with `velocity` for `seconds`. Gives the scans that
  /// end in this step.
  std::vector<SensedScan> step(const PlanarPose& begin_W, const BodyVelocity& velocity, Time now,
                               double seconds);

  /// X_OR by the wheels, `seconds` after the present step's beginning.
  [[nodiscard]] PlanarPose odometry(double seconds) const;
  /// Length of the present step, 0 before the first.
  [[nodiscard]] double present_seconds() const {
    return motions_.empty() ? 0.0 : motions_.back().seconds;
  }

 private:
  /// One step's motion, kept for as long as a scan may reach back.
  struct Motion {
    Time begin;
    double seconds = 0.0;
    PlanarPose begin_W;
    BodyVelocity velocity;
    PlanarPose begin_O;
    PlanarPose increment;  ///< By the wheels, over the whole step.
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
  std::deque<Motion> motions_;  ///< The present one last.
  std::uint64_t steps_ = 0;
  std::int64_t next_scan_ = 0;
};

}  // namespace tagfield
