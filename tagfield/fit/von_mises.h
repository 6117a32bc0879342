// SPDX-License-Identifier: Apache-2.0
/// @file
/// The von Mises distribution, of noise on a circle.
#pragma once

namespace tagfield {

/// Concentration κ of von Mises noise whose mean cosine is `mean_cosine`, in [0, 1): the inverse of
/// I₁(κ)/I₀(κ), within 1 % (Best and Fisher, Communications in Statistics B 10, 1981).
double von_mises_concentration(double mean_cosine);

}  // namespace tagfield
