// SPDX-License-Identifier: Apache-2.0
/// @file
/// Numbers from text, the same in every locale.
#pragma once

#include <optional>
#include <string>

namespace tagfield {

/// `text` as a finite decimal number ("-1.5", "+3", "2e-3"), if the whole of it is one; nullopt for
/// anything else: spaces, "nan", "inf", hexadecimal, or a number above the largest double.
std::optional<double> parse_number(const std::string& text);

}  // namespace tagfield
