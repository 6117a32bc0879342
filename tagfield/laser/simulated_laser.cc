// SPDX-License-Identifier: Apache-2.0
#include "tagfield/laser/simulated_laser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>

#include "tagfield/base/random.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr int kMaxBeams = 100'000;
constexpr double kMaxMetres = 1000.0;
constexpr double kMaxRateHz = 10'000.0;
constexpr double kMaxSigmaM = 10.0;
/// A full turn, with tolerance for values written with nine decimals.
constexpr double kFullTurn = kTwoPi + 1e-8;

/// Horizontal projection of a ray: points origin + t·direction, where t is the distance along the
/// 3D ray [m], so that `direction` is shorter than 1 if the ray is not level.
struct FlatRay {
  Eigen::Vector2d origin;
  Eigen::Vector2d direction;
};

FlatRay seen_from_above(const Ray& ray) {
  return {ray.origin.head<2>().cast<double>(), ray.direction.head<2>().cast<double>()};
}

/// The lesser of `least` and t, if t ≥ 0. Ignores NaN, as from a vertical ray.
double nearer(double t, double least) { return t >= 0.0 && t < least ? t : least; }

/// Solves |origin + t·direction − centre| = radius.
double nearer(const Disc& disc, const FlatRay& ray, double least) {
  const Eigen::Vector2d from_centre = ray.origin - disc.centre;
  const double a = ray.direction.squaredNorm();
  const double half_b = ray.direction.dot(from_centre);
  const double c = from_centre.squaredNorm() - disc.radius * disc.radius;
  const double discriminant = half_b * half_b - a * c;
  if (!(discriminant >= 0.0)) return least;
  const double root = std::sqrt(discriminant);
  return nearer((-half_b + root) / a, nearer((-half_b - root) / a, least));
}

/// A rectangle with its axes in the world frame.
struct Slabs {
  Eigen::Vector2d centre;
  Eigen::Matrix2d axes;  ///< One per row.
  Eigen::Vector2d half;  ///< [m]
};

Slabs slabs_of(const Rectangle& rectangle) {
  const auto [s, c] = sine_cosine(rectangle.yaw);
  Eigen::Matrix2d axes;
  axes << c, s, -s, c;
  return {rectangle.centre, axes, 0.5 * rectangle.size};
}

/// The ray is inside both pairs of edges between `in` and `out`.
double nearer(const Slabs& slabs, const FlatRay& ray, double least) {
  const Eigen::Vector2d origin = slabs.axes * (ray.origin - slabs.centre);
  const Eigen::Vector2d direction = slabs.axes * ray.direction;
  double in = -std::numeric_limits<double>::infinity();
  double out = std::numeric_limits<double>::infinity();
  for (int axis = 0; axis < 2; ++axis) {
    if (direction[axis] == 0.0) {
      if (std::abs(origin[axis]) > slabs.half[axis]) return least;
      continue;
    }
    const double one = (-slabs.half[axis] - origin[axis]) / direction[axis];
    const double other = (slabs.half[axis] - origin[axis]) / direction[axis];
    in = std::max(in, std::min(one, other));
    out = std::min(out, std::max(one, other));
  }
  return in <= out ? nearer(out, nearer(in, least)) : least;
}

bool is_finite(const Disc& disc) { return disc.centre.allFinite() && std::isfinite(disc.radius); }

bool is_finite(const Rectangle& rectangle) {
  return rectangle.centre.allFinite() && rectangle.size.allFinite() && std::isfinite(rectangle.yaw);
}

LaserScan empty_scan(const LaserParameters& laser, std::int64_t number) {
  LaserScan scan;
  scan.stamp = scan_stamp(laser, number);
  const int steps = laser.beams - 1;
  // Rounded down to a whole nanosecond, so that the last beam is not after the sweep.
  scan.beam_interval = duration_from_seconds(laser.sweep_s) / steps;
  scan.first_angle_rad = laser.first_angle_rad;
  scan.angle_step_rad = (laser.last_angle_rad - laser.first_angle_rad) / steps;
  scan.min_range_m = laser.min_range_m;
  scan.max_range_m = laser.max_range_m;
  scan.ranges_m.resize(static_cast<std::size_t>(laser.beams));
  return scan;
}

/// Data shared by all beams of one instant.
struct View {
  Eigen::Matrix3d R_WL;
  Eigen::Vector3f origin;
  std::vector<Disc> discs;
  std::vector<Slabs> rectangles;
};

void add_obstacles(const Obstacles& obstacles, View& view) {
  for (const Disc& disc : obstacles.discs) {
    if (is_finite(disc)) view.discs.push_back(disc);
  }
  for (const Rectangle& rectangle : obstacles.rectangles) {
    if (is_finite(rectangle)) view.rectangles.push_back(slabs_of(rectangle));
  }
}

View view_at(const LaserParameters& laser, Time time,
             const std::function<RigidTransform(Time)>& pose_at,
             const std::function<Obstacles(Time)>& obstacles_at) {
  const RigidTransform X_WL = pose_at(time) * laser.X_RL;
  View view{X_WL.rotation.toRotationMatrix(), X_WL.translation.cast<float>(), {}, {}};
  if (obstacles_at) add_obstacles(obstacles_at(time), view);
  return view;
}

/// Distance to the nearest obstacle, or infinity.
double to_obstacle(const View& view, const Ray& ray) {
  double least = std::numeric_limits<double>::infinity();
  const FlatRay flat = seen_from_above(ray);
  for (const Disc& disc : view.discs) least = nearer(disc, flat, least);
  for (const Slabs& rectangle : view.rectangles) least = nearer(rectangle, flat, least);
  return least;
}

/// Rays of the beams, and the distance to the nearest obstacle for each.
struct Beams {
  std::vector<Ray> rays;
  std::vector<double> to_obstacles;
};

Beams beams_of(const LaserParameters& laser, const LaserScan& scan,
               const std::function<RigidTransform(Time)>& pose_at,
               const std::function<Obstacles(Time)>& obstacles_at) {
  // Slightly further, so that a wall exactly at the maximum range is hit.
  const float max_m = nothing_range(laser.max_range_m);
  const Eigen::Matrix2d turn = rotation_in_plane(scan.angle_step_rad);
  Eigen::Vector2d direction_L(cosine(scan.first_angle_rad), sine(scan.first_angle_rad));
  Beams beams;
  beams.rays.reserve(scan.ranges_m.size());
  beams.to_obstacles.reserve(scan.ranges_m.size());
  View view = view_at(laser, scan.stamp, pose_at, obstacles_at);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (i > 0 && scan.beam_interval > Duration{}) {
      const auto later = scan.beam_interval * static_cast<std::int64_t>(i);
      view = view_at(laser, scan.stamp + later, pose_at, obstacles_at);
    }
    const Eigen::Vector3d direction = view.R_WL.leftCols<2>() * direction_L;
    beams.rays.push_back({view.origin, direction.cast<float>(), max_m});
    beams.to_obstacles.push_back(to_obstacle(view, beams.rays.back()));
    direction_L = turn * direction_L;
  }
  return beams;
}

/// Range that the laser reports for a true distance.
float measured(const LaserParameters& laser, double distance_m, double noise_m) {
  if (!(distance_m <= laser.max_range_m)) return nothing_range(laser.max_range_m);
  const double range = distance_m + noise_m;
  if (distance_m < laser.min_range_m || range < laser.min_range_m || range <= 0.0) return 0.0F;
  if (range > laser.max_range_m) return nothing_range(laser.max_range_m);
  return static_cast<float>(range);
}

}  // namespace

void check(const LaserParameters& laser) {
  const double span = laser.last_angle_rad - laser.first_angle_rad;
  const double mounted_m = laser.X_RL.translation.norm();
  const double length = laser.X_RL.rotation.norm();
  require(laser.beams >= 2 && laser.beams <= kMaxBeams, "laser: beams",
          fmt::format("2 to {}", kMaxBeams), laser.beams);
  require(std::abs(laser.first_angle_rad) <= kFullTurn, "laser: first_angle_rad", "within ±2π",
          laser.first_angle_rad);
  require(span > 0.0 && span <= kFullTurn, "laser: last_angle_rad",
          "greater than first_angle_rad, by 2π at most", laser.last_angle_rad);
  require(laser.min_range_m >= 0.0, "laser: min_range_m", "0 or more", laser.min_range_m);
  require(laser.max_range_m > laser.min_range_m && laser.max_range_m <= kMaxMetres,
          "laser: max_range_m", fmt::format("greater than min_range_m and {} at most", kMaxMetres),
          laser.max_range_m);
  require(laser.rate_hz > 0.0 && laser.rate_hz <= kMaxRateHz, "laser: rate_hz",
          fmt::format("greater than 0 and {} at most", kMaxRateHz), laser.rate_hz);
  require(laser.sigma_m >= 0.0 && laser.sigma_m <= kMaxSigmaM, "laser: sigma_m",
          fmt::format("0 to {}", kMaxSigmaM), laser.sigma_m);
  require(laser.sweep_s >= 0.0 && laser.sweep_s < 1.0 / laser.rate_hz, "laser: sweep_s",
          "0 or more and less than 1/rate_hz", laser.sweep_s);
  require(mounted_m <= kMaxMetres, "laser: X_RL",
          fmt::format("within {} m of the base", kMaxMetres), mounted_m);
  require(std::abs(length - 1.0) < 1e-6, "laser: X_RL", "a rotation, of length 1", length);
}

Time scan_stamp(const LaserParameters& laser, std::int64_t number) {
  return time_from_seconds(static_cast<double>(number) / laser.rate_hz);
}

LaserScan simulate_scan(const RayScene& world, const LaserParameters& laser, std::int64_t number,
                        const std::function<RigidTransform(Time)>& pose_at,
                        const std::function<Obstacles(Time)>& obstacles_at, std::uint64_t seed,
                        std::uint64_t key) {
  check(laser);
  LaserScan scan = empty_scan(laser, number);
  const Beams beams = beams_of(laser, scan, pose_at, obstacles_at);
  world.distances(beams.rays, scan.ranges_m);

  RandomStream stream(seed, Purpose::kLaser, key, static_cast<std::uint64_t>(number));
  std::array<double, 2> noise{};
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (i % 2 == 0) noise = standard_normal_pair(stream);
    const double distance_m =
        std::min(static_cast<double>(scan.ranges_m[i]), beams.to_obstacles[i]);
    scan.ranges_m[i] = measured(laser, distance_m, laser.sigma_m * noise[i % 2]);
  }
  return scan;
}

}  // namespace tagfield
