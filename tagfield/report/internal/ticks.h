// SPDX-License-Identifier: Apache-2.0
/// @file
/// Round numbers for the axes of figures.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// Multiples of 1, 2 or 5 times a power of ten from at or below `low` to at or above `high`,
/// rising, at least two of them and about `count` (never over twice that).
std::vector<double> covering_ticks(double low, double high, int count);

/// The same, but only those in [low, high].
std::vector<double> inner_ticks(double low, double high, int count);

/// 1, 2 and 5 times powers of ten (powers only, where the range is wide) in [low, high], 0 < low.
std::vector<double> logarithmic_ticks(double low, double high);

/// Each with the decimals that tell it from its neighbours, and a true minus sign.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);

/// Each with just the decimals that it has: "0.5", "20".
std::vector<std::string> logarithmic_labels(const std::vector<double>& ticks);

}  // namespace tagfield
