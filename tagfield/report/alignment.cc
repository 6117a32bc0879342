// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/alignment.h"

#include <cmath>

namespace tagfield {
namespace {

Eigen::Vector2d mean_of(const std::vector<Eigen::Vector2d>& places) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& place : places) sum += place;
  return sum / static_cast<double>(places.size());
}

Eigen::Vector2d turned(const Eigen::Vector2d& p, double yaw_rad) {
  const double c = std::cos(yaw_rad);
  const double s = std::sin(yaw_rad);
  return {c * p.x() - s * p.y(), s * p.x() + c * p.y()};
}

}  // namespace

Eigen::Vector2d PlanarMotion::operator*(const Eigen::Vector2d& p) const {
  return turned(p, yaw_rad) + shift_m;
}

PlanarMotion best_motion(const std::vector<Eigen::Vector2d>& from,
                         const std::vector<Eigen::Vector2d>& to) {
  if (from.empty()) return {};
  const Eigen::Vector2d from_mean = mean_of(from);
  const Eigen::Vector2d to_mean = mean_of(to);
  double cosine = 0.0;
  double sine = 0.0;
  for (std::size_t i = 0; i < from.size(); ++i) {
    const Eigen::Vector2d a = from[i] - from_mean;
    const Eigen::Vector2d b = to[i] - to_mean;
    cosine += a.dot(b);
    sine += a.x() * b.y() - a.y() * b.x();
  }
  const double yaw_rad = std::atan2(sine, cosine);
  return {yaw_rad, to_mean - turned(from_mean, yaw_rad)};
}

}  // namespace tagfield
