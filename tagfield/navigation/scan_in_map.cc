// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_in_map.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/lanes.h"
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

/// Points that were computed as if seen from where the robot was at `pose_M`, and how much later
/// they were seen.
struct LatePoints {
  std::vector<double> x_M;
  std::vector<double> y_M;
  std::vector<double> later_s;
};

/// Corrects the points' positions for the arc that the robot has driven since: transformed() of
/// between() by advance(), for all points in lanes, with the same bits. `later_s` and the robot's
/// yaw must be in the domain of lane_sine_cosine().
inline void carry(const PlanarPose& pose_M, const SineCosine& heading, const BodyVelocity& velocity,
                  LatePoints& points) {
  const std::size_t count = points.x_M.size();
  double* const x_M = points.x_M.data();
  double* const y_M = points.y_M.data();
  const double* const later_s = points.later_s.data();
  const double s = heading.sine;
  const double c = heading.cosine;
#pragma GCC ivdep
  for (std::size_t i = 0; i < count; ++i) {
    const double dx = x_M[i] - pose_M.x;
    const double dy = y_M[i] - pose_M.y;
    const double x_R = c * dx + s * dy;
    const double y_R = -s * dx + c * dy;
    const double turned = velocity.turn * later_s[i];
    const double half = turned / 2.0;
    const bool is_straight = std::abs(half) < 1e-6;
    const double bend = lane_sine_cosine(half).sine / choose(is_straight, 1.0, half);
    const double shortening = choose(is_straight, 1.0 - half * half / 6.0, bend);
    const double chord = velocity.forward * later_s[i] * shortening;
    const SineCosine mean = lane_sine_cosine(pose_M.yaw + half);
    const SineCosine end = lane_sine_cosine(pose_M.yaw + turned);
    x_M[i] = pose_M.x + chord * mean.cosine + end.cosine * x_R - end.sine * y_R;
    y_M[i] = pose_M.y + chord * mean.sine + end.sine * x_R + end.cosine * y_R;
  }
}

/// The same for each point by itself, whatever the angles.
void carry_each(const PlanarPose& pose_M, const BodyVelocity& velocity, LatePoints& points) {
  for (std::size_t i = 0; i < points.x_M.size(); ++i) {
    const PlanarPose in_robot = between(pose_M, {points.x_M[i], points.y_M[i], 0.0});
    const Eigen::Vector2d p_M =
        transformed(advance(pose_M, velocity, points.later_s[i]), {in_robot.x, in_robot.y});
    points.x_M[i] = p_M.x();
    points.y_M[i] = p_M.y();
  }
}

void place_returns(const LaserScan& scan, const PlanarPose& pose_M, const BodyVelocity& velocity,
                   ScanInMap& seen) {
  const double interval_s = to_seconds(scan.beam_interval);
  // Each beam's direction is the previous one rotated, which is faster than computing sines.
  const double first_angle = seen.q_ML.yaw + scan.first_angle_rad;
  Eigen::Vector2d direction_M(cosine(first_angle), sine(first_angle));
  const Eigen::Matrix2d turn = rotation_in_plane(scan.angle_step_rad);
  LatePoints points;
  for (std::vector<double>* const column : {&points.x_M, &points.y_M, &points.later_s}) {
    column->reserve(scan.ranges_m.size());
  }
  for (std::size_t i = 0; i < scan.ranges_m.size(); ++i) {
    if (beam_of(scan, scan.ranges_m[i]) == Beam::kReturn) {
      const auto range = static_cast<double>(scan.ranges_m[i]);
      const Eigen::Vector2d point_M = position_of(seen.q_ML) + range * direction_M;
      points.x_M.push_back(point_M.x());
      points.y_M.push_back(point_M.y());
      points.later_s.push_back(static_cast<double>(i) * interval_s);
      seen.returns.push_back({point_M, range, i});
    }
    direction_M = turn * direction_M;
  }
  if (!(interval_s > 0.0)) return;
  const double most_s = static_cast<double>(scan.ranges_m.size()) * interval_s;
  const double most_rad = std::abs(pose_M.yaw) + std::abs(velocity.turn) * most_s;
  if (most_rad <= kMaxLaneTurn_rad) {
    in_lanes(instruction_sets().back(),
             [&] { carry(pose_M, sine_cosine(pose_M.yaw), velocity, points); });
  } else {
    carry_each(pose_M, velocity, points);
  }
  // The first beam is not late.
  for (std::size_t i = 0; i < seen.returns.size(); ++i) {
    if (points.later_s[i] > 0.0) seen.returns[i].point_M = {points.x_M[i], points.y_M[i]};
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
