// SPDX-License-Identifier: Apache-2.0
/// @file
/// What an antenna sends where: gain and polarization over direction. See docs/antennas.md.
#pragma once

#include <Eigen/Core>
#include <complex>
#include <string>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// Shapes of the gain over direction.
enum class PatternShape {
  kIsotropic,  ///< The same everywhere.
  kPatch,      ///< A lobe cosⁿ, n from the beam widths, and a back of constant gain.
  kDipole,     ///< A half-wave dipole, [cos(½π cos θ)/sin θ]².
  kTable,      ///< Samples of two cuts.
};

enum class PolarizationKind { kLinear, kRightCircular, kLeftCircular };

/// Gain along two cuts through the boresight: of a table's row.
struct PatternSample {
  double angle_rad = 0.0;       ///< Off the boresight, 0 to π.
  double horizontal_dbi = 0.0;  ///< Where the cut is the antenna's x, y plane;
  double vertical_dbi = 0.0;    ///< the x, z plane.
};

/// An antenna in its frame A: boresight along x, y to the left, z up (REP-103).
struct AntennaPattern {
  PatternShape shape = PatternShape::kIsotropic;
  double gain_dbi = 0.0;  ///< At its greatest.
  /// Full widths of the lobe at half of the greatest power (a patch's), in the x, y and the x, z
  /// plane.
  double beam_width_rad = 0.0;
  double vertical_beam_width_rad = 0.0;
  double front_to_back_db = 20.0;    ///< How much weaker a patch's back is.
  std::vector<PatternSample> table;  ///< Rising angles from 0 to π.
  PolarizationKind polarization = PolarizationKind::kLinear;
  /// Of a linear polarization and of a dipole's wire: 0 along z (vertical), growing towards y.
  double tilt_rad = 0.0;
};

/// Throws Error naming the parameter that is out of its range. A gain that is more than the lobe's
/// width allows is warned of.
void check(const AntennaPattern& pattern, Diagnostics& diagnostics);

/// Greatest gain [dBi] that a lossless antenna with this lobe can have: its directivity.
double directivity_dbi(const AntennaPattern& pattern);

/// Power gain (linear) in the direction of the unit vector `u_A`, in A.
double gain(const AntennaPattern& pattern, const Eigen::Vector3d& u_A);

/// Greatest power gain (linear).
double peak_gain(const AntennaPattern& pattern);

/// Unit vector in A of the electric field that goes out along the unit vector `u_A`, across it:
/// complex where circular. It is that of a wire, or of two crossed wires where circular, whatever
/// the shape of the gain. As receiver the antenna takes in E·e, not conjugated, of what comes from
/// there.
Eigen::Vector3cd field_direction(const AntennaPattern& pattern, const Eigen::Vector3d& u_A);

}  // namespace tagfield
