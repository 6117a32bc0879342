// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks of settings, with one form of error message: "NAME must be EXPECTED, is VALUE".
#pragma once

#include <string_view>

namespace tagfield {

/// Upper limit of lengths and coordinates in settings [m]: no hall is longer, but values in wrong
/// units or entered by mistake mostly are.
inline constexpr double kMaxLength_m = 1e5;

/// Same, for positions in tables and bags, which may be sums of several such lengths.
inline constexpr double kMaxCoordinate_m = 1e6;

/// Throws Error unless `holds`.
void require(bool holds, std::string_view name, std::string_view expected, double value);

/// Throws Error unless `value` is from `least` to `most`; the message gives both in `unit`, if
/// there is one.
void require_in_range(std::string_view name, double value, double least, double most,
                      std::string_view unit = "");

/// Throws Error unless `value` is finite and greater than 0.
void require_positive(std::string_view name, double value);

/// Throws Error unless `value` is finite and 0 or more.
void require_not_negative(std::string_view name, double value);

}  // namespace tagfield
