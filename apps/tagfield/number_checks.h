// SPDX-License-Identifier: Apache-2.0
/// @file
/// Checks of options with numbers, as CLI11 calls them: "" or what is wrong.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tagfield {

std::string fault_of_positive(const std::string& word);
std::string fault_of_non_negative(const std::string& word);
/// Of a carrier in Hz.
std::string fault_of_carrier(const std::string& word);

/// CLI11's ranges let NaN pass: refuses it in all options of `app` and its commands.
void refuse_nan(CLI::App& app);

}  // namespace tagfield
