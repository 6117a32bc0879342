// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a flat surface does to a plane wave, by Recommendation ITU-R P.2040-1, section 2.2. Fields
/// go with e^{+jωt}. See docs/multipath.md.
#pragma once

#include <complex>

namespace tagfield {

/// A pair of complex amplitude factors: TE, with the electric field across the plane of incidence,
/// and TM, with it in that plane. Directions of the TM field are s × k before and after, s being
/// the normal of the plane of incidence, so that a perfect conductor has TE −1 and TM +1.
struct FresnelPair {
  std::complex<double> te;
  std::complex<double> tm;
};

/// Reflection by a half space of relative permittivity `eta` (imaginary part 0 or less), under
/// `cos_incidence` in [0, 1] from the normal: eqs. (31a) and (31b) of P.2040-1.
FresnelPair half_space_reflection(std::complex<double> eta, double cos_incidence);

/// Reflection by a slab in air, `thickness_m` ≥ 0 thick, at wavelength `lambda_m`: eq. (43a).
FresnelPair slab_reflection(std::complex<double> eta, double cos_incidence, double thickness_m,
                            double lambda_m);

/// Transmission through that slab against the same way through air: eq. (43b) with the phase that
/// the wave would have had anyway taken out, so that air gives 1.
FresnelPair slab_transmission(std::complex<double> eta, double cos_incidence, double thickness_m,
                              double lambda_m);

}  // namespace tagfield
