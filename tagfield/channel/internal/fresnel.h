// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reflection and transmission of a plane wave at a flat surface, by Recommendation ITU-R P.2040-1,
/// section 2.2. Time dependence is e^{+jωt}. See docs/multipath.md.
#pragma once

#include <complex>

namespace tagfield {

/// A pair of complex amplitude factors: TE, with the electric field perpendicular to the plane of
/// incidence, and TM, with it in that plane. The TM field is along s × k before and after, where s
/// is the normal of the plane of incidence, so that a perfect conductor has TE −1 and TM +1.
struct FresnelPair {
  std::complex<double> te;
  std::complex<double> tm;
};

/// Reflection by a half space of relative permittivity `eta` (imaginary part 0 or less), at an
/// angle of incidence with the cosine `cos_incidence` in [0, 1]: eqs. (31a) and (31b) of P.2040-1.
FresnelPair half_space_reflection(std::complex<double> eta, double cos_incidence);

/// Reflection by a slab in air, `thickness_m` ≥ 0 thick, at wavelength `lambda_m`: eq. (43a).
FresnelPair slab_reflection(std::complex<double> eta, double cos_incidence, double thickness_m,
                            double lambda_m);

/// Transmission through that slab relative to the same path through air: eq. (43b) with the phase
/// of that path removed, so that air gives 1.
FresnelPair slab_transmission(std::complex<double> eta, double cos_incidence, double thickness_m,
                              double lambda_m);

}  // namespace tagfield
