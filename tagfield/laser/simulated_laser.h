// SPDX-License-Identifier: Apache-2.0
/// @file
/// Simulation of a Hokuyo-like laser scanner in a world. docs/laser.md has the equations.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/laser/laser_scan.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield {

/// Defaults: the P3-AT's scanner as in models/p3at.
struct LaserParameters {
  int beams = 720;
  double first_angle_rad = -1.570796327;
  double last_angle_rad = 1.570796327;
  double min_range_m = 0.3;
  double max_range_m = 30.0;
  double rate_hz = 30.0;
  double sigma_m = 0.01;  ///< Standard deviation of a range.
  double sweep_s = 0.0;   ///< From the first beam to the last; less than 1/rate_hz.
  RigidTransform X_RL = from_translation({0.15, 0.0, 0.31});  ///< On the robot's base.
};

/// Throws Error on parameters out of range, naming the parameter: 2 to 100,000 beams over more than
/// 0 and at most 2π; 0 ≤ least < most ≤ 1000 m; 0 < rate ≤ 10,000 Hz; 0 ≤ sigma ≤ 10 m; 0 ≤ sweep <
/// 1/rate; a finite position within 1000 m of the robot's base.
void check(const LaserParameters& laser);

/// A vertical cylindrical obstacle that is not part of the static world: its outline in the
/// horizontal plane at the time of a beam.
struct Disc {
  Eigen::Vector2d centre;  ///< [m, world]
  double radius = 0.0;     ///< [m]
};
/// Outline of a box on the floor, rotated by `yaw`.
struct Rectangle {
  Eigen::Vector2d centre;  ///< [m, world]
  Eigen::Vector2d size;    ///< Edge lengths [m].
  double yaw = 0.0;        ///< [rad]
};
/// Moving obstacles, assumed to be taller than the laser's height, whatever that is. Outlines are
/// surfaces, visible from both sides; obstacles that are not finite are ignored.
struct Obstacles {
  std::vector<Disc> discs;
  std::vector<Rectangle> rectangles;
};

/// Simulates scan `number` (stamp = number / rate). `pose_at` gives X_WR at a time in [stamp, stamp
/// + sweep_s], so that each beam starts at the scanner's current pose; `obstacles_at` gives the
/// moving obstacles (or is nullptr). Both are called once per beam, in time order, or only once if
/// sweep_s is 0. Noise is keyed by (seed, key, number): the same arguments give the same scan.
///
/// A true distance d in [least, most] gives a return of d + N(0, sigma_m²), or 0 if the noise takes
/// it below `least` and no hit if above `most`. Regardless of noise, d < least gives 0 and d > most
/// no hit. Throws Error as check() does.
LaserScan simulate_scan(const RayScene& world, const LaserParameters& laser, std::int64_t number,
                        const std::function<RigidTransform(Time)>& pose_at,
                        const std::function<Obstacles(Time)>& obstacles_at, std::uint64_t seed,
                        std::uint64_t key);

/// Timestamp of scan `number`. Throws Error beyond ±146 years.
Time scan_stamp(const LaserParameters& laser, std::int64_t number);

}  // namespace tagfield
