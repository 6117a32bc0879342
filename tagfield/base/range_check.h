// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks of what is set, with one form of complaint: "NAME must be EXPECTED, is VALUE".
#pragma once

#include <string_view>

namespace tagfield {

/// The most that a length or a coordinate may be set to [m]: no hall is longer, and what is told in
/// other units or by mistake mostly is.
inline constexpr double kMostLength_m = 1e5;

/// The same of places in tables and bags, which may be sums of several of those.
inline constexpr double kMostCoordinate_m = 1e6;

/// Throws Error unless `holds`.
void require(bool holds, std::string_view name, std::string_view expected, double value);

/// Throws Error unless `value` is from `least` to `most`; both are told in `unit`, if there is one.
void require_in_range(std::string_view name, double value, double least, double most,
                      std::string_view unit = "");

/// Throws Error unless `value` is finite and greater than 0.
void require_positive(std::string_view name, double value);

/// Throws Error unless `value` is finite and 0 or more.
void require_not_negative(std::string_view name, double value);

}  // namespace tagfield
