// SPDX-License-Identifier: Apache-2.0
/// @file
/// A robot's pose from its wheel encoders.
#pragma once

#include <Eigen/Core>
#include <optional>

#include "tagfield/motion/unicycle.h"

namespace tagfield {

/// Angles of the left and right wheels, not wrapped [rad].
struct WheelAngles {
  double left = 0.0;
  double right = 0.0;
};

struct OdometrySettings {
  /// The track is the effective one, with which turns on the spot come out right. If the wheels
  /// skid, it is larger than the distance between them.
  DriveGeometry drive;
  double encoder_step_rad = 0.0;  ///< Angle of one encoder tick; 0 for an ideal encoder.
  /// Assumed error of a side's travel: its σ after d metres is wheel_noise·√d [m/√m].
  double wheel_noise = 0.0;
};

/// Integrates the wheels' motion into a pose (eqs. (6)–(8)), exact for constant speeds between two
/// calls, and propagates its covariance.
class WheelOdometry {
 public:
  explicit WheelOdometry(const OdometrySettings& settings) : settings_(settings) {}

  /// To be called often with the wheels' angles; the first call sets the reference.
  void update(const WheelAngles& angles);

  /// Relative to the pose at the first call.
  [[nodiscard]] const PlanarPose& pose() const { return pose_; }
  /// Of x, y [m] and yaw [rad], by linear propagation of the wheels' errors.
  [[nodiscard]] const Eigen::Matrix3d& covariance() const { return covariance_; }
  /// Sum of all motion since the first call, forward [m] and turning [rad]; its difference over an
  /// interval gives the mean velocity.
  [[nodiscard]] const BodyVelocity& travel() const { return travel_; }

 private:
  [[nodiscard]] WheelAngles encoded(const WheelAngles& angles) const;
  void grow_covariance(const BodyVelocity& moved, const WheelSpeeds& turned);

  OdometrySettings settings_;
  std::optional<WheelAngles> start_;
  WheelAngles last_;
  PlanarPose pose_;
  BodyVelocity travel_;
  Eigen::Matrix3d covariance_ = Eigen::Matrix3d::Zero();
};

}  // namespace tagfield
