// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/internal/process_noise.h"

#include <algorithm>
#include <cmath>

namespace tagfield {
namespace {

/// Power density of the acceleration in x and y [m²/s³].
Eigen::Matrix2d acceleration_density(const TrackingOptions& options) {
  const double all = options.acceleration_noise * options.acceleration_noise;
  Eigen::Matrix2d density = all * Eigen::Matrix2d::Identity();
  if (!options.lane) return density;
  const Lane& lane = *options.lane;
  const Eigen::Vector2d along(std::cos(lane.heading_rad), std::sin(lane.heading_rad));
  const double more = lane.acceleration_noise * lane.acceleration_noise - all;
  if (more > 0.0) density += more * along * along.transpose();
  return density;
}

}  // namespace

double largest_acceleration_noise(const TrackingOptions& options) {
  return std::max(options.acceleration_noise,
                  options.lane ? options.lane->acceleration_noise : 0.0);
}

Matrix6d process_noise(const TrackingOptions& options, double time_s) {
  const Eigen::Matrix2d density = acceleration_density(options);
  Matrix6d noise = Matrix6d::Zero();
  noise.block<2, 2>(0, 0) = density * (time_s * time_s * time_s / 3.0);
  noise.block<2, 2>(0, 3) = noise.block<2, 2>(3, 0) = density * (time_s * time_s / 2.0);
  noise.block<2, 2>(3, 3) = density * time_s;
  return noise;
}

}  // namespace tagfield
