// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antennas whose poses are wheel odometry, and its errors, as CSV:
/// `antenna,x_m,y_m,z_m,qx,qy,qz,qw,alpha1,alpha2,alpha3,alpha4`.
#pragma once

#include <map>
#include <string>

#include "tagfield/motion/odometry_noise.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// An antenna on a robot that believes its wheel odometry.
struct OdometryOfAntenna {
  RigidTransform X_PA;  ///< The antenna in the robot's frame, which is that of the odometry.
  OdometryNoise noise;
};

using OdometryByAntenna = std::map<std::string, OdometryOfAntenna>;

/// Text of the table.
std::string odometry_to_csv(const OdometryByAntenna& odometry);

/// Reads the table. Throws Error "FILE:LINE: …", also on an antenna that is listed twice and on a
/// negative parameter.
OdometryByAntenna read_odometry_csv(const std::string& path);

}  // namespace tagfield
