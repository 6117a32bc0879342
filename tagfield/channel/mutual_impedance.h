// SPDX-License-Identifier: Apache-2.0
/// @file
/// Coupling of two dipoles close to each other: their mutual impedance by the induced EMF method.
/// See docs/coupling.md.
#pragma once

#include <Eigen/Core>
#include <complex>

namespace tagfield {

/// Self-impedance of a thin half-wave dipole [Ω]: the mutual impedance of two at the same position.
/// Textbooks that use 120π Ω as the impedance of free space give 73.13 + j42.54.
inline constexpr std::complex<double> kDipoleImpedance_ohm{73.0790, 42.5151};

/// Minimum separation of two dipoles across their wires, because strips have a width [m].
inline constexpr double kMinAcross_m = 1e-3;

/// E₁(jx) = −Ci(x) + j(Si(x) − π/2) for x > 0: the exponential integral of an imaginary argument.
std::complex<double> exponential_integral(double x);

/// Mutual impedance [Ω] of two parallel thin half-wave dipoles with sinusoidal currents, at wave
/// number `k` [rad/m]: their centres are `across_m` apart perpendicular to the wires and `along_m`
/// along them. An `across_m` below kMinAcross_m is raised to it. P. S. Carter, Circuit relations
/// in radiating systems, Proc. IRE 20(6), 1932; in closed form as in C. A. Balanis, Antenna Theory,
/// section 8.6.
std::complex<double> parallel_impedance(double k, double across_m, double along_m);

/// Mutual impedance of two half-wave dipoles with wires along the unit vectors `axis_a` and
/// `axis_b` and with the offset `between` from centre to centre [m]: that of parallel ones along
/// the mean of both axes, multiplied by the cosine of the angle between them. Symmetric; reversing
/// an axis only changes the sign.
std::complex<double> mutual_impedance(double k, const Eigen::Vector3d& axis_a,
                                      const Eigen::Vector3d& axis_b,
                                      const Eigen::Vector3d& between);

/// How much of the field at each of several half-wave dipoles reaches the chip of the first: entry
/// j is the weight of the field that dipole j alone would receive; (1, 0, …) without coupling. All
/// chips are matched to an isolated dipole, Z_L = Z_A*, so the row is 2 R_A times the first row of
/// (Z + Z_L)⁻¹. By reciprocity it also applies to transmission by the first. `mutual` contains the
/// off-diagonal entries of Z, symmetric.
Eigen::RowVectorXcd coupled_shares(const Eigen::MatrixXcd& mutual);

}  // namespace tagfield
