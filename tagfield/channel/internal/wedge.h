// SPDX-License-Identifier: Apache-2.0
/// @file
/// Diffraction at an edge by the uniform theory of diffraction. R. G. Kouyoumjian, P. H. Pathak, A
/// uniform geometrical theory of diffraction for an edge in a perfectly conducting surface, Proc.
/// IEEE 62(11), 1974. Time dependence is e^{+jωt}.
#pragma once

#include <array>
#include <complex>

namespace tagfield {

/// F(x) = 2j √x e^{jx} ∫_{√x}^∞ e^{−jτ²} dτ for x ≥ 0: 0 at 0, 1 far away; to 1e-10.
std::complex<double> transition(double x);

/// ∫_a^∞ e^{−jτ²} dτ for any a.
std::complex<double> fresnel_tail(double a);

/// Positions of both ends around a wedge, and distances.
struct WedgeGeometry {
  double exterior_rad = 0.0;  ///< nπ.
  double antenna_rad = 0.0;   ///< φ', from face 0.
  double tag_rad = 0.0;       ///< φ.
  double sin_beta = 1.0;      ///< Sine of the angle between ray and edge, greater than 0.
  double wave_number = 0.0;   ///< [rad/m]
  double distance_m = 0.0;    ///< L = s s' sin²β₀/(s + s').
};

/// The four terms of the diffraction coefficient [√m]. Each compensates for the discontinuity of
/// geometrical optics at one boundary; multiplied by the field that vanishes there, they add up to
/// the diffracted field.
struct WedgeTerms {
  /// At the shadow boundary of the incident field on face 0, and on the other face.
  std::array<std::complex<double>, 2> shadow;
  /// At the reflection boundary of each face.
  std::array<std::complex<double>, 2> mirror;
};

WedgeTerms wedge_terms(const WedgeGeometry& wedge);

}  // namespace tagfield
