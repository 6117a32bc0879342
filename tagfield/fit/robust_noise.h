// SPDX-License-Identifier: Apache-2.0
/// @file
/// Noise by what a fit leaves unexplained.
#pragma once

#include <cstddef>
#include <vector>

namespace tagfield {

/// Standard deviation of the noise whose residuals these are, so many unknowns fitted to it; from
/// the median, so that those that belong nowhere don't count. At least `least`; residuals must not
/// be empty.
double robust_noise(const std::vector<double>& residuals, std::size_t unknowns, double least);

}  // namespace tagfield
