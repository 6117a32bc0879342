// SPDX-License-Identifier: Apache-2.0
/// @file
/// Directional gain and polarization of an antenna. See docs/antennas.md.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// Shapes of the directional gain.
enum class PatternShape {
  kIsotropic,  ///< The same in all directions.
  kPatch,      ///< A main lobe cosⁿ, with n from the beam widths, and a back of constant gain.
  kDipole,     ///< A half-wave dipole, [cos(½π cos θ)/sin θ]².
  kTable,      ///< Samples of two cuts.
};

enum class PolarizationKind { kLinear, kRightCircular, kLeftCircular };

/// Gain in two cuts through the boresight: one row of a table.
struct PatternSample {
  double angle_rad = 0.0;       ///< From the boresight, 0 to π.
  double horizontal_dbi = 0.0;  ///< In the cut of the antenna's x, y plane;
  double vertical_dbi = 0.0;    ///< in that of the x, z plane.
};

/// An antenna in its frame A: boresight along x, y to the left, z up (REP-103).
struct AntennaPattern {
  PatternShape shape = PatternShape::kIsotropic;
  double gain_dbi = 0.0;  ///< Peak gain.
  /// Full half-power widths of a patch's main lobe in the x, y and the x, z plane.
  double beam_width_rad = 0.0;
  double vertical_beam_width_rad = 0.0;
  double front_to_back_db = 20.0;    ///< A patch's peak gain over that of its back.
  std::vector<PatternSample> table;  ///< Angles in ascending order from 0 to π.
  PolarizationKind polarization = PolarizationKind::kLinear;
  /// Tilt of a linear polarization and of a dipole's wire: 0 along z (vertical), increasing towards
  /// y.
  double tilt_rad = 0.0;
};

/// Throws Error naming the parameter that is out of range. Warns of a gain too high for the lobe's
/// width.
void check(const AntennaPattern& pattern, Diagnostics& diagnostics);

/// Directivity: the peak gain [dBi] of a lossless antenna with this pattern.
double directivity_dbi(const AntennaPattern& pattern);

/// Power gain (linear) in the direction of the unit vector `u_A`, in A.
double gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A);

/// Peak power gain (linear).
double peak_gain(const AntennaPattern& pattern);

/// Unit vector in A of the electric field radiated along the unit vector `u_A`, perpendicular to
/// it; complex for circular polarization. It is the field of a wire, or of two crossed wires for
/// circular polarization, whatever the shape of the gain. As a receiver, the antenna receives E·e,
/// without conjugation, of a wave from that direction.
Eigen::Vector3cd field_direction(const AntennaPattern& pattern, const Eigen::Vector3d& u_A);

}  // namespace tagfield
