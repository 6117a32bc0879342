// SPDX-License-Identifier: Apache-2.0
#include "tagfield/motion/wheel_odometry.h"

#include <cmath>

#include "tagfield/base/trigonometry.h"

namespace tagfield {

WheelAngles WheelOdometry::encoded(const WheelAngles& angles) const {
  const WheelAngles turned{angles.left - start_->left, angles.right - start_->right};
  const double step = settings_.encoder_step_rad;
  if (!(step > 0.0)) return turned;
  return {std::floor(turned.left / step) * step, std::floor(turned.right / step) * step};
}

void WheelOdometry::update(const WheelAngles& angles) {
  if (!start_) start_ = angles;
  const WheelAngles now = encoded(angles);
  const WheelSpeeds turned{now.left - last_.left, now.right - last_.right};
  last_ = now;
  if (turned.left == 0.0 && turned.right == 0.0) return;
  const BodyVelocity moved = body_velocity(settings_.drive, turned);
  grow_covariance(moved, turned);
  pose_ = advance(pose_, moved, 1.0);
  travel_.forward += moved.forward;
  travel_.turn += moved.turn;
}

/// To first order in the step: P' = F P Fᵀ + G Q Gᵀ, where Q holds the variances of the two sides'
/// travel.
void WheelOdometry::grow_covariance(const BodyVelocity& moved, const WheelSpeeds& turned) {
  const double heading = pose_.yaw + moved.turn / 2.0;
  const auto [s, c] = sine_cosine(heading);
  Eigen::Matrix3d F = Eigen::Matrix3d::Identity();
  F(0, 2) = -moved.forward * s;
  F(1, 2) = moved.forward * c;
  const double track = settings_.drive.track_m;
  Eigen::Matrix<double, 3, 2> G;
  G << c / 2.0, c / 2.0, s / 2.0, s / 2.0, -1.0 / track, 1.0 / track;
  const double variance_per_rad =
      settings_.wheel_noise * settings_.wheel_noise * settings_.drive.wheel_radius_m;
  const Eigen::Vector2d Q =
      variance_per_rad * Eigen::Vector2d(std::abs(turned.left), std::abs(turned.right));
  covariance_ = F * covariance_ * F.transpose() + G * Q.asDiagonal() * G.transpose();
}

}  // namespace tagfield
