#include "tagfield/navigation/scan_points.h"

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

}  // namespace tagfield
