// SPDX-License-Identifier: Apache-2.0
/// @file
/// Drift of the believed poses of robots that rely on their wheels alone.
#pragma once

#include "tagfield/experiment/odometry_csv.h"
#include "tagfield/localization/problem.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// The four parameters of a robot whose wheels are each measured with the standard deviation
/// `wheel_noise` [m] after 1 m, independently. With the track d and a wheel's travel s_L or s_R,
/// the heading's variance is noise² (|s_L| + |s_R|)/d² and the distance's a quarter of noise²
/// (|s_L| + |s_R|). Where a robot drives an arc these parameters add its turning to its driving,
/// which overstates the variance by at most |turn| d/2 relative to the distance.
OdometryNoise noise_of_wheels(double wheel_noise, const DriveGeometry& drive);

/// The antennas on robots that believe their wheels: with `pose.source: odometry` those on all
/// robots, else those on the robot that is driven from outside, if any. The errors are those in
/// force: of `pose.wheel_noise`, or of `navigation.odometry` for the driven robot.
OdometryByAntenna odometry_of(const Scenario& scenario);

/// The drift of these antennas since their robots' start; null if there are none.
DriftOf drift_by(OdometryByAntenna odometry);

/// Same, of odometry_of() the scenario.
DriftOf odometry_drift(const Scenario& scenario);

}  // namespace tagfield
