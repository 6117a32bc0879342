// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics that a few values far off don't move.
#pragma once

#include <vector>

namespace tagfield {

/// The middle of the sorted values, the greater of two; 0 of none.
double median(std::vector<double> values);

/// Standard deviation of normal values around 0 by their median magnitude, which is 0.6745 σ
/// (Huber, Robust Statistics, 1981); 0 of none.
double sigma_by_median(std::vector<double> values);

}  // namespace tagfield
