// SPDX-License-Identifier: Apache-2.0
/// @file
/// Round numbers for the axes of figures.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// Multiples of 1, 2 or 5 times a power of ten that cover `low` … `high`, in ascending order: at
/// least two and about `count` (never more than twice that).
std::vector<double> covering_ticks(double low, double high, int count);

/// Same, but only those in [low, high].
std::vector<double> inner_ticks(double low, double high, int count);

/// 1, 2 and 5 times powers of ten (powers only, if the range is wide) in [low, high], 0 < low.
std::vector<double> logarithmic_ticks(double low, double high);

/// Labels with the decimals needed to distinguish neighbours, and a typographic minus sign.
std::vector<std::string> tick_labels(const std::vector<double>& ticks);

/// Labels without trailing zeros: "0.5", "20".
std::vector<std::string> logarithmic_labels(const std::vector<double>& ticks);

}  // namespace tagfield
