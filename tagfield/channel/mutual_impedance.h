// SPDX-License-Identifier: Apache-2.0
/// @file
/// How two dipoles near one another couple: their mutual impedance by the induced EMF method. See
/// docs/coupling.md.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace tagfield {

/// Impedance of a thin half-wave dipole alone [Ω]: the mutual one of two in the same place. Books
/// that take 120π Ω for the impedance of free space have 73.13 + j42.54.
inline constexpr std::complex<double> kDipoleImpedance_ohm{73.0790, 42.5151};

/// No two dipoles count as nearer across their wires than this, as strips have a width [m].
inline constexpr double kLeastAcross_m = 1e-3;

/// E₁(jx) = −Ci(x) + j(Si(x) − π/2) for x > 0: the exponential integral of an imaginary argument.
std::complex<double> exponential_integral(double x);

/// Mutual impedance [Ω] of two parallel thin half-wave dipoles with sinusoidal currents, at wave
/// number `k` [rad/m]: their centres are `across_m` apart across the wires and `along_m` along
/// them. Less than kLeastAcross_m across counts as that. P. S. Carter, Circuit relations in
/// radiating systems, Proc. IRE 20(6), 1932; in closed form as in C. A. Balanis, Antenna Theory,
/// section 8.6.
std::complex<double> parallel_impedance(double k, double across_m, double along_m);

/// Of two half-wave dipoles with wires along the unit vectors `axis_a` and `axis_b` whose centres
/// are `between` apart [m]: that of parallel ones along the mean of both axes, times the cosine of
/// the angle between them. The same from both sides, whichever way round the axes are told but for
/// the sign.
std::complex<double> mutual_impedance(double k, const Eigen::Vector3d& axis_a,
                                      const Eigen::Vector3d& axis_b,
                                      const Eigen::Vector3d& between);

/// What of the field at each of some half-wave dipoles gets to the chip of the first: entry j is
/// the share of the field that dipole j takes in alone; (1, 0, …) where nothing couples. All chips
/// are matched to a dipole alone, Z_L = Z_A*, so that the row is 2 R_A times the first of
/// (Z + Z_L)⁻¹. By reciprocity it serves for what the first sends as well. `mutual` holds Z's
/// entries off the diagonal, symmetric.
Eigen::RowVectorXcd coupled_shares(const Eigen::MatrixXcd& mutual);

}  // namespace tagfield
