#include "navigation/scan_points.h"

#include <algorithm>
#include <cmath>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {

ScanPoints scan_points(const LaserScan& scan, const RigidTransform& X_RL, double most_clear_m) {
  const PlanarPose q_RL = planar(X_RL);
  ScanPoints points;
  points.sensor_R = position_of(q_RL);
  if (!std::isfinite(scan.first_angle_rad) || !std::isfinite(scan.angle_step_rad)) return points;
  points.ends_R.reserve(scan.ranges_m.size());
  const double clear_m = std::min(most_clear_m, scan.most_range_m);
  double angle = scan.first_angle_rad;
  for (const float range : scan.ranges_m) {
    const Eigen::Vector2d direction_L(std::cos(angle), std::sin(angle));
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
                                         int beams, double least_apart_m) {
  const std::size_t all = scan.ranges_m.size();
  const std::size_t skip =
      std::max<std::size_t>(all / static_cast<std::size_t>(std::max(beams, 1)), 1);
  const std::size_t count = (all - 1) / skip + 1;
  const double each = scan.angle_step_rad * static_cast<double>(skip);
  const double last = scan.first_angle_rad + each * static_cast<double>(count - 1);
  const double aperture = static_cast<float>(last - scan.first_angle_rad);
  const double middle = 0.5 * (scan.first_angle_rad + last);
  const double yaw = yaw_of(X_RL.rotation) + middle;
  const auto c = static_cast<float>(std::cos(yaw));
  const auto s = static_cast<float>(std::sin(yaw));
  const Eigen::Vector2f from = X_RL.translation.head<2>().cast<float>();
  const auto d = static_cast<float>(least_apart_m);
  std::vector<Eigen::Vector2f> ends;
  double angle = -0.5 * aperture;
  bool after_return = true;
  for (std::size_t i = 0; i < count; ++i) {
    const float range = scan.ranges_m[i * skip];
    const bool is_return = beam_of(scan, range) == Beam::kReturn;
    if (is_return) {
      const float x = range * static_cast<float>(std::cos(angle));
      const float y = range * static_cast<float>(std::sin(angle));
      const Eigen::Vector2f end(from.x() + (x * c - y * s), from.y() + (x * s + y * c));
      const bool far = after_return && (ends.empty() || (end - ends.back()).squaredNorm() > d * d);
      if (ends.empty() || far || i + 1 == count) ends.push_back(end);
    }
    after_return = is_return;
    angle += aperture / static_cast<double>(count - 1);
  }
  return ends;
}

}  // namespace tagfield
