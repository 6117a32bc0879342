#include "tagfield/motion/odometry_noise.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// A turn, a straight way (negative backwards), a turn.
struct Parts {
  double first = 0.0;
  double way = 0.0;
  double second = 0.0;
};

Parts parts_of(const PlanarPose& increment) {
  Parts parts;
  parts.way = std::hypot(increment.x, increment.y);
  // A robot that drives backwards has not turned round twice.
  if (increment.x < 0.0) parts.way = -parts.way;
  // The direction of no way at all is none.
  if (std::abs(parts.way) > 1e-9) {
    const double sign = parts.way < 0.0 ? -1.0 : 1.0;
    parts.first = std::atan2(sign * increment.y, sign * increment.x);
  }
  parts.second = wrap_to_pi(increment.yaw - parts.first);
  return parts;
}

/// Variances of the three parts. What driving does to the heading is shared by the two turns.
Eigen::Vector3d variances_of(const Parts& parts, const OdometryNoise& noise) {
  const double way = std::abs(parts.way);
  const auto squared = [](double x) { return x * x; };
  const double by_driving = 0.5 * squared(noise.alpha2) * way;
  const double turns = std::abs(parts.first) + std::abs(parts.second);
  return {squared(noise.alpha1) * std::abs(parts.first) + by_driving,
          squared(noise.alpha3) * way + squared(noise.alpha4) * turns,
          squared(noise.alpha1) * std::abs(parts.second) + by_driving};
}

}  // namespace

void check(const OdometryNoise& noise) {
  const auto expect = [](const char* name, double value) {
    if (std::isfinite(value) && value >= 0.0) return;
    throw Error(fmt::format("{} must be a finite number and not negative, is {}", name, value));
  };
  expect("alpha1", noise.alpha1);
  expect("alpha2", noise.alpha2);
  expect("alpha3", noise.alpha3);
  expect("alpha4", noise.alpha4);
}

PlanarPose noisy_increment(const PlanarPose& increment, const OdometryNoise& noise,
                           RandomStream& stream) {
  const Parts parts = parts_of(increment);
  const Eigen::Vector3d sigma = variances_of(parts, noise).cwiseSqrt();
  const auto [first_draw, way_draw] = standard_normal_pair(stream);
  const double first = parts.first + sigma.x() * first_draw;
  const double way = parts.way + sigma.y() * way_draw;
  const double second = parts.second + sigma.z() * standard_normal(stream);
  return {way * std::cos(first), way * std::sin(first), first + second};
}

Eigen::Matrix3d increment_covariance(const PlanarPose& increment, const OdometryNoise& noise) {
  const Parts parts = parts_of(increment);
  const double c = std::cos(parts.first);
  const double s = std::sin(parts.first);
  Eigen::Matrix3d J;
  J << -parts.way * s, c, 0.0, parts.way * c, s, 0.0, 1.0, 0.0, 1.0;
  return J * variances_of(parts, noise).asDiagonal() * J.transpose();
}

}  // namespace tagfield
