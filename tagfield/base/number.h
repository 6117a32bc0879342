// SPDX-License-Identifier: Apache-2.0
/// @file
/// Numbers from text, the same in every locale.
#pragma once

#include <optional>
#include <string>

namespace tagfield {

/// The finite decimal number that the whole of `text` is ("-1.5", "+3", "2e-3"); none for anything
/// else: spaces, "nan", "inf", hexadecimal, or a number beyond the largest double.
std::optional<double> parse_number(const std::string& text);

}  // namespace tagfield
