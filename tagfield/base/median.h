// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics that are robust to a few outliers.
#pragma once

#include <vector>

namespace tagfield {

/// The median, the greater of the two middle values for an even number; 0 for none.
double median(std::vector<double> values);

/// Standard deviation of normal values around 0, estimated from their median magnitude, which is
/// 0.6745 σ (Huber, Robust Statistics, 1981); 0 for none.
double sigma_by_median(std::vector<double> values);

}  // namespace tagfield
