// SPDX-License-Identifier: Apache-2.0
/// @file
/// Noise estimation from the residuals of a fit.
#pragma once

#include <cstddef>
#include <vector>

namespace tagfield {

/// Standard deviation of the noise from residuals of a fit with `unknowns` unknowns; by the median,
/// so that outliers have no influence. At least `least`; residuals must not be empty.
double robust_noise(const std::vector<double>& residuals, std::size_t unknowns, double least);

}  // namespace tagfield
