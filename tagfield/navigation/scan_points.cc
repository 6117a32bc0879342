// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/scan_points.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Endpoints of the first and every `skip`-th beam after it, in single precision.
std::vector<std::optional<Eigen::Vector2f>> ends_of_every(const LaserScan& scan,
                                                          const RigidTransform& X_RL,
                                                          std::size_t skip) {
  const std::size_t last = (scan.ranges_m.size() - 1) / skip;
  const double span = scan.angle_step_rad * static_cast<double>(skip * last);
  const double half = 0.5 * static_cast<double>(static_cast<float>(span));
  const double step = 2.0 * half / std::max(static_cast<double>(last), 1.0);
  // Angles are relative to the middle one.
  const Eigen::Matrix2f R =
      rotation_in_plane(yaw_of(X_RL.rotation) + scan.first_angle_rad + 0.5 * span).cast<float>();
  const Eigen::Vector2f sensor_R = X_RL.translation.head<2>().cast<float>();
  std::vector<std::optional<Eigen::Vector2f>> ends(last + 1);
  for (std::size_t i = 0; i <= last; ++i) {
    const float range = scan.ranges_m[i * skip];
    if (beam_of(scan, range) != Beam::kReturn) continue;
    const double angle = step * static_cast<double>(i) - half;
    const Eigen::Vector2d direction(cosine(angle), sine(angle));
    ends[i] = sensor_R + R * (range * direction.cast<float>());
  }
  return ends;
}

}  // namespace

ScanPoints scan_points(const LaserScan& scan, const RigidTransform& X_RL, double max_clear_m) {
  const PlanarPose q_RL = planar(X_RL);
  ScanPoints points;
  points.sensor_R = position_of(q_RL);
  if (!std::isfinite(scan.first_angle_rad) || !std::isfinite(scan.angle_step_rad)) return points;
  points.ends_R.reserve(scan.ranges_m.size());
  const double clear_m = std::min(max_clear_m, scan.max_range_m);
  double angle = scan.first_angle_rad;
  for (const float range : scan.ranges_m) {
    const Eigen::Vector2d direction_L(cosine(angle), sine(angle));
    angle += scan.angle_step_rad;
    switch (beam_of(scan, range)) {
      case Beam::kReturn:
        points.ends_R.push_back(transformed(q_RL, direction_L * static_cast<double>(range)));
        break;
      case Beam::kNothing:
        points.clear_R.push_back(transformed(q_RL, direction_L * clear_m));
        break;
      case Beam::kInvalid:
        break;
    }
  }
  return points;
}

std::vector<Eigen::Vector2d> thinned(const std::vector<Eigen::Vector2d>& points, double spacing_m) {
  std::vector<Eigen::Vector2d> kept;
  for (const Eigen::Vector2d& point : points) {
    if (kept.empty() || (point - kept.back()).squaredNorm() >= spacing_m * spacing_m) {
      kept.push_back(point);
    }
  }
  return kept;
}

std::vector<Eigen::Vector2f> sparse_ends(const LaserScan& scan, const RigidTransform& X_RL,
                                         int beams, double apart_m) {
  if (scan.ranges_m.empty()) return {};
  const std::size_t skip = scan.ranges_m.size() / static_cast<std::size_t>(std::max(beams, 1));
  const auto all = ends_of_every(scan, X_RL, std::max<std::size_t>(skip, 1));
  const auto apart = static_cast<float>(apart_m);
  std::vector<Eigen::Vector2f> ends;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (!all[i]) continue;
    const bool after_gap = i > 0 && !all[i - 1];
    const auto is_far = [&] { return (*all[i] - ends.back()).squaredNorm() > apart * apart; };
    if (ends.empty() || (!after_gap && is_far()) || i + 1 == all.size()) ends.push_back(*all[i]);
  }
  return ends;
}

}  // namespace tagfield
