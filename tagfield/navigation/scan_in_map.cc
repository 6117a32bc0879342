// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_in_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

Eigen::Vector2d polar(double angle_rad, double range_m) {
  return {range_m * cosine(angle_rad), range_m * sine(angle_rad)};
}

/// Adds points at the minimum range where a run of neighbouring beams is invalid.
void add_blind(const LaserScan& scan, std::size_t begin, std::size_t end, ScanInMap& seen) {
  if (static_cast<double>(end - begin) * scan.angle_step_rad < ScanInMap::kMinBlind) return;
  // One point every 3° leaves no gap that matters at a range of decimetres.
  const auto stride = static_cast<std::size_t>(std::max(1.0, 0.05 / scan.angle_step_rad));
  for (std::size_t i = begin; i < end; i += stride) {
    seen.may_be_M.push_back(transformed(seen.q_ML, polar(beam_angle(scan, i), scan.min_range_m)));
  }
}

void find_blind(const LaserScan& scan, ScanInMap& seen) {
  std::size_t begin = 0;
  for (std::size_t i = 0; i <= seen.clear_m.size(); ++i) {
    if (i < seen.clear_m.size() && seen.clear_m[i] <= 0.0) continue;
    add_blind(scan, begin, i, seen);
    begin = i + 1;
  }
}

/// Corrected position of a point that was seen `later_s` after the robot was at `pose_M` but
/// computed as if seen from there.
Eigen::Vector2d carried(const PlanarPose& pose_M, const BodyVelocity& velocity, double later_s,
                        const Eigen::Vector2d& point_M) {
  const PlanarPose in_robot = between(pose_M, {point_M.x(), point_M.y(), 0.0});
  return transformed(advance(pose_M, velocity, later_s), {in_robot.x, in_robot.y});
}

void place_returns(const LaserScan& scan, const PlanarPose& pose_M, const BodyVelocity& velocity,
                   ScanInMap& seen) {
  const double interval_s = to_seconds(scan.beam_interval);
  // Each beam's direction is the previous one rotated, which is faster than computing sines.
  const double first_angle = seen.q_ML.yaw + scan.first_angle_rad;
  Eigen::Vector2d direction_M(cosine(first_angle), sine(first_angle));
  const Eigen::Matrix2d turn = rotation_in_plane(scan.angle_step_rad);
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (beam_of(scan, scan.ranges_m[i]) == Beam::kReturn) {
      const auto range = static_cast<double>(scan.ranges_m[i]);
      const double later_s = static_cast<double>(i) * interval_s;
      const Eigen::Vector2d point_M = position_of(seen.q_ML) + range * direction_M;
      seen.returns.push_back(
          {later_s > 0.0 ? carried(pose_M, velocity, later_s, point_M) : point_M, range, i});
    }
    direction_M = turn * direction_M;
  }
}

bool is_sound(const LaserScan& scan) {
  return std::isfinite(scan.first_angle_rad) && std::isfinite(scan.angle_step_rad) &&
         scan.angle_step_rad > 0.0 && std::isfinite(scan.min_range_m) &&
         std::isfinite(scan.max_range_m);
}

}  // namespace

double ScanInMap::clear_towards(const Eigen::Vector2d& p_M, double half_width_rad) const {
  const Eigen::Vector2d away = p_M - position_of(q_ML);
  const double bearing = wrap_to_pi(arc_tangent(away.y(), away.x()) - q_ML.yaw - first_angle_rad);
  // Beams may begin at any angle; those past ±π are one full turn further on.
  const double past = bearing < -half_width_rad ? bearing + kTwoPi : bearing;
  const double first = std::floor((past - half_width_rad) / angle_step_rad);
  const double last = std::ceil((past + half_width_rad) / angle_step_rad);
  if (clear_m.empty() || !(last >= 0.0) || first > static_cast<double>(clear_m.size()) - 1.0) {
    return 0.0;
  }
  const auto begin = static_cast<std::size_t>(std::max(0.0, first));
  const auto end = std::min(clear_m.size(), static_cast<std::size_t>(last) + 1);
  return *std::min_element(clear_m.begin() + static_cast<std::ptrdiff_t>(begin),
                           clear_m.begin() + static_cast<std::ptrdiff_t>(end));
}

ScanInMap scan_in_map(const LaserScan& scan, const RigidTransform& X_RL, const PlanarPose& pose_M,
                      const BodyVelocity& velocity) {
  const PlanarPose q_RL = planar(X_RL);
  ScanInMap seen;
  seen.stamp = scan.stamp;
  seen.q_ML = compose(pose_M, q_RL);
  if (!is_sound(scan)) return seen;
  seen.first_angle_rad = scan.first_angle_rad;
  seen.angle_step_rad = scan.angle_step_rad;
  for (const float range : scan.ranges_m) {
    const Beam beam = beam_of(scan, range);
    const double clear = beam == Beam::kNothing ? scan.max_range_m : static_cast<double>(range);
    seen.clear_m.push_back(beam == Beam::kInvalid ? 0.0 : clear);
  }
  place_returns(scan, pose_M, velocity, seen);
  const auto valid = std::count_if(seen.clear_m.begin(), seen.clear_m.end(),
                                   [](double clear) { return clear > 0.0; });
  if (valid > 0) {
    seen.valid_share = static_cast<double>(valid) / static_cast<double>(seen.clear_m.size());
  }
  find_blind(scan, seen);
  return seen;
}

}  // namespace tagfield
