// SPDX-License-Identifier: Apache-2.0
/// @file
/// A room for the tests of mapping and localization: walls, boxes, and a robot's drive in it.
#pragma once

#include <Eigen/Geometry>
#include <functional>
#include <utility>
#include <vector>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/world/ray_scene.h"

namespace tagfield {

inline Collision box_at(double x, double y, double size_x, double size_y) {
  return {"box", Box{{size_x, size_y, 2.0}}, from_translation({x, y, 1.0})};
}

/// 8.05 m by 6.05 m around the origin, so that the walls' surfaces are at the centres of a map's 5
/// cm cells. Boxes in the corners tell them apart.
inline Scene room() {
  Scene scene;
  scene.collisions = {box_at(0.0, 3.125, 8.4, 0.2),    box_at(0.0, -3.125, 8.4, 0.2),
                      box_at(4.125, 0.0, 0.2, 6.4),    box_at(-4.125, 0.0, 0.2, 6.4),
                      box_at(3.525, 2.725, 1.0, 0.6),  box_at(-3.675, -2.575, 0.7, 0.9),
                      box_at(-3.775, 2.775, 0.5, 0.5), box_at(3.825, -1.0, 0.4, 1.3)};
  return scene;
}

/// A drive by velocities, each held for some seconds.
struct Drive {
  PlanarPose start;
  std::vector<std::pair<BodyVelocity, double>> legs;
};

/// Twice around the centre of the room.
inline Drive loop() {
  return {
      {-1.0, -1.0, 0.0},
      {{{0.0, 0.0}, 0.7}, {{0.0, 0.7}, 2.0 * kPi / 0.7}, {{0.3, 0.25}, 2.0 * 2.0 * kPi / 0.25}}};
}

using OnScan =
    std::function<void(const LaserScan&, const PlanarPose& odometry, const PlanarPose& truth)>;

inline void sense(const Scene& scene, const Drive& drive, const OdometryNoise& noise,
                  std::uint64_t seed, const OnScan& on_scan) {
  const RayScene rays(scene);
  const LaserParameters laser;
  RandomStream stream(seed, Purpose::kWheelOdometry, 7);
  PlanarPose truth = drive.start;
  PlanarPose odometry;
  std::int64_t number = 0;
  const double step = 1.0 / laser.rate_hz;
  for (const auto& [velocity, seconds] : drive.legs) {
    for (double t = 0.0; t < seconds; t += step) {
      const auto pose = [&truth](Time) { return to_transform(truth); };
      on_scan(simulate_scan(rays, laser, number++, pose, nullptr, seed, 7), odometry, truth);
      const PlanarPose next = advance(truth, velocity, step);
      odometry = compose(odometry, noisy_increment(between(truth, next), noise, stream));
      truth = next;
    }
  }
}

inline double distance(const PlanarPose& a, const PlanarPose& b) {
  return (position_of(a) - position_of(b)).norm();
}

}  // namespace tagfield
