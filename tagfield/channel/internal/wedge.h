// SPDX-License-Identifier: Apache-2.0
/// @file
/// What an edge makes of a wave: the uniform theory of diffraction. R. G. Kouyoumjian, P. H.
/// Pathak, A uniform geometrical theory of diffraction for an edge in a perfectly conducting
/// surface, Proc. IEEE 62(11), 1974. Fields go with e^{+jωt}.
#pragma once

#include <array>
#include <complex>

namespace tagfield {

/// F(x) = 2j √x e^{jx} ∫_{√x}^∞ e^{−jτ²} dτ for x ≥ 0: 0 at 0, 1 far away; to 1e-10.
std::complex<double> transition(double x);

/// ∫_a^∞ e^{−jτ²} dτ for any a.
std::complex<double> fresnel_tail(double a);

/// Where the ends are around a wedge, and how far from it.
struct WedgeGeometry {
  double exterior_rad = 0.0;  ///< nπ.
  double antenna_rad = 0.0;   ///< φ', from face 0.
  double tag_rad = 0.0;       ///< φ.
  double sin_beta = 1.0;      ///< Of the angle between ray and edge, above 0.
  double wave_number = 0.0;   ///< [rad/m]
  double distance_m = 0.0;    ///< L = s s' sin²β₀/(s + s').
};

/// The four terms of the diffraction coefficient [√m]. Each makes good for what geometrical optics
/// drops at one boundary; times what it drops there they are the diffracted field.
struct WedgeTerms {
  /// At the shadow that the antenna's light on face 0, or on the other one, leaves behind.
  std::array<std::complex<double>, 2> shadow;
  /// Where the mirrored light of that face ends.
  std::array<std::complex<double>, 2> mirror;
};

WedgeTerms wedge_terms(const WedgeGeometry& wedge);

}  // namespace tagfield
