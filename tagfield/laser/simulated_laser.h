/// @file
/// A Hokuyo-like laser scanner in a world.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield {

/// Defaults: the P3-AT's scanner as in models/p3at.
struct LaserParameters {
  int beams = 720;
  double first_angle_rad = -1.570796327;
  double last_angle_rad = 1.570796327;
  double least_range_m = 0.3;
  double most_range_m = 30.0;
  double rate_hz = 30.0;
  double sigma_m = 0.01;        ///< Standard deviation of a range.
  double sweep_s = 0.0;         ///< From the first beam to the last; less than 1/rate_hz.
  RigidTransform X_RL = from_translation({0.15, 0.0, 0.31});  ///< On the robot's base.
};

/// Throws Error on parameters out of range, naming the parameter.
void check(const LaserParameters& laser);

/// An upright obstacle that is not part of the world at rest: its outline in the laser's plane at
/// the time of a beam.
struct Disc {
  Eigen::Vector2d centre;  ///< [m, world]
  double radius = 0.0;     ///< [m]
};
/// A box on the floor seen from above, turned by `yaw`.
struct Rectangle {
  Eigen::Vector2d centre;  ///< [m, world]
  Eigen::Vector2d size;    ///< Edge lengths [m].
  double yaw = 0.0;        ///< [rad]
};
struct Obstacles {
  std::vector<Disc> discs;
  std::vector<Rectangle> rectangles;
};

/// Scan `number` (stamp = number / rate). `pose_at` gives X_WR at a time in
/// [stamp, stamp + sweep_s], so that each beam leaves from where the scanner is then;
/// `obstacles_at` what moves (or nullptr). Noise is keyed by (seed, key, number): the same
/// arguments give the same scan.
LaserScan simulate_scan(const RayScene& world, const LaserParameters& laser, std::int64_t number,
                        const std::function<RigidTransform(Time)>& pose_at,
                        const std::function<Obstacles(Time)>& obstacles_at, std::uint64_t seed,
                        std::uint64_t key);

/// Stamp of scan `number`.
Time scan_stamp(const LaserParameters& laser, std::int64_t number);

}  // namespace tagfield
