// SPDX-License-Identifier: Apache-2.0
/// @file
/// Laser scans of the robots, for viewers.
#pragma once

#include <chrono>
#include <nlohmann/json_fwd.hpp>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/live/live_world.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield::http {

/// Each robot has the laser that the scenario's `navigation` describes.
class LaserView {
 public:
  LaserView(const Scene& scene, const Scenario& scenario, std::uint64_t seed);

  /// One scan per robot: {"robot", "origin": the scanner's pose [x, y, z, qx, qy, qz, qw],
  /// "angle_min", "angle_step" [rad], "ranges" [m], 0 where nothing is within range}. Null if the
  /// time has not advanced since the last scans, or they were returned less than a tenth of a
  /// second of real time ago, unless `needed`.
  nlohmann::ordered_json scans(const LiveWorld& world, bool needed);

 private:
  RayScene rays_;
  LaserParameters laser_;
  std::uint64_t seed_;
  Time sent_{Duration::min()};                       ///< Simulated time of the last scans.
  std::chrono::steady_clock::time_point sent_at_{};  ///< Their real time.
};

}  // namespace tagfield::http
