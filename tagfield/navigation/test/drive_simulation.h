// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot that drives in a small simulated world, for tests: unicycle, laser, people, and
/// collisions.
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "tagfield/laser/simulated_laser.h"
#include "tagfield/map/top_view.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/goal_driver.h"

namespace tagfield::testing {

/// Footprint of a P3-AT.
inline constexpr double kHalfLength = 0.255;
inline constexpr double kHalfWidth = 0.25;

/// Distance from the robot's footprint to a point [m]; 0 inside.
inline double outline_distance(const PlanarPose& pose, const Eigen::Vector2d& p) {
  const PlanarPose q = between(pose, {p.x(), p.y(), 0.0});
  return std::hypot(std::max(0.0, std::abs(q.x) - kHalfLength),
                    std::max(0.0, std::abs(q.y) - kHalfWidth));
}

/// Edges of the world's solids seen from above, between two heights, in a grid of square bins.
class Edges {
 public:
  Edges() = default;
  Edges(const Scene& scene, double z_low, double z_high) {
    for (const Silhouette& silhouette : top_view(scene, z_low, z_high, 0.0005)) {
      for (const Polygon& ring : silhouette.rings) {
        for (std::size_t i = 0; i < ring.size(); ++i) add(ring[i], ring[(i + 1) % ring.size()]);
      }
    }
  }

  void add(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    const Eigen::Vector2d low = a.cwiseMin(b).array() - kReach;
    const Eigen::Vector2d high = a.cwiseMax(b).array() + kReach;
    for (int y = square(low.y()); y <= square(high.y()); ++y) {
      for (int x = square(low.x()); x <= square(high.x()); ++x) squares_[{x, y}].push_back({a, b});
    }
  }

  /// Whether an edge passes through the robot's footprint.
  [[nodiscard]] bool touch(const PlanarPose& pose) const { return distance(pose) <= 0.0; }

  /// Distance from the footprint to the nearest edge [m], at most about kReach minus half its
  /// diagonal.
  [[nodiscard]] double distance(const PlanarPose& pose) const {
    const auto found = squares_.find({square(pose.x), square(pose.y)});
    double nearest = kReach - std::hypot(kHalfLength, kHalfWidth);
    if (found == squares_.end()) return nearest;
    for (const auto& [a, b] : found->second) nearest = std::min(nearest, distance(pose, a, b));
    return nearest;
  }

 private:
  static constexpr double kReach = 1.0;
  static int square(double x) { return static_cast<int>(std::floor(x)); }

  /// Samples points a millimetre apart near the robot: slow, but hard to get wrong.
  static double distance(const PlanarPose& pose, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b) {
    const Eigen::Vector2d way = b - a;
    const double length = way.norm();
    const double foot = std::clamp(
        length > 0.0 ? (position_of(pose) - a).dot(way) / (length * length) : 0.0, 0.0, 1.0);
    const double off = (a + foot * way - position_of(pose)).norm();
    if (off > kReach) return kReach;
    double nearest = outline_distance(pose, a + foot * way);
    const double step = length > 0.0 ? 0.005 / length : 1.0;
    for (double s = std::max(0.0, foot - 0.5 / std::max(length, 1e-9));
         s <= std::min(1.0, foot + 0.5 / std::max(length, 1e-9)); s += step) {
      nearest = std::min(nearest, outline_distance(pose, a + s * way));
    }
    return nearest;
  }

  std::map<std::pair<int, int>, std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>> squares_;
};

/// One drive and its outcome.
struct DriveSimulation {
  const RayScene* world = nullptr;
  const Edges* edges = nullptr;  ///< May be nullptr: then nothing is measured.
  LaserParameters laser;
  SpeedLimits limits;
  std::function<Obstacles(Time)> obstacles_at;  ///< May be nullptr.
  /// Error of the estimated pose, in the robot's frame.
  std::function<PlanarPose(Time)> belief_error;
  std::uint64_t seed = 1;

  PlanarPose pose;  ///< True.
  BodyVelocity velocity;
  std::int64_t step = 0;
  double min_distance_m = std::numeric_limits<double>::infinity();  ///< To the world's edges.
  double min_to_discs_m = std::numeric_limits<double>::infinity();
  double min_to_boxes_m = std::numeric_limits<double>::infinity();
  double driven_m = 0.0;
  std::vector<PlanarPose> trail;

  static constexpr int kStepsPerSecond = 60;

  [[nodiscard]] Time now() const {
    return time_from_seconds(static_cast<double>(step) / kStepsPerSecond);
  }
  [[nodiscard]] PlanarPose believed() const {
    return belief_error ? compose(pose, belief_error(now())) : pose;
  }

  /// One step: a scan if one is due, a decision, motion.
  void advance_by(GoalDriver& driver) {
    const double dt = 1.0 / kStepsPerSecond;
    if (step % 2 == 0) {
      const RigidTransform X_WR = to_transform(pose);
      driver.see(simulate_scan(
                     *world, laser, step / 2, [&](Time) { return X_WR; }, obstacles_at, seed, 7),
                 believed());
    }
    const BodyVelocity wanted = driver.next(believed(), velocity, now());
    velocity = limited(wanted, velocity, limits, dt);
    pose = advance(pose, velocity, dt);
    driven_m += std::abs(velocity.forward) * dt;
    ++step;
    measure();
  }

  void measure() {
    if (edges) min_distance_m = std::min(min_distance_m, edges->distance(pose));
    if (step % 6 == 0) trail.push_back(pose);
    if (!obstacles_at) return;
    const Obstacles obstacles = obstacles_at(now());
    for (const Disc& disc : obstacles.discs) {
      min_to_discs_m = std::min(min_to_discs_m, outline_distance(pose, disc.centre) - disc.radius);
    }
    for (const Rectangle& box : obstacles.rectangles) {
      Edges outline;
      for (int i = 0; i < 4; ++i) outline.add(corner(box, i), corner(box, i + 1));
      min_to_boxes_m = std::min(min_to_boxes_m, outline.distance(pose));
    }
  }

  static Eigen::Vector2d corner(const Rectangle& box, int i) {
    const double x = 0.5 * box.size.x() * ((i % 4 == 0 || i % 4 == 3) ? 1.0 : -1.0);
    const double y = 0.5 * box.size.y() * (i % 4 < 2 ? 1.0 : -1.0);
    return transformed({box.centre.x(), box.centre.y(), box.yaw}, {x, y});
  }

  /// Runs until the driver is done or `max_s` seconds have passed.
  void run(GoalDriver& driver, double max_s) {
    const std::int64_t last = step + static_cast<std::int64_t>(max_s * kStepsPerSecond);
    while (driver.state() == DriveState::kDriving && step < last) advance_by(driver);
  }
};

}  // namespace tagfield::testing
