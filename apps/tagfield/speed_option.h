// SPDX-License-Identifier: Apache-2.0
/// @file
/// --speed, which means the same in each command that has it.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace tagfield {

/// Adds it under `names`: a multiple of real time up to 1e6; 0, for which "max" can be written, is
/// as fast as it can. `otherwise` says what is without it.
CLI::Option* add_speed_option(CLI::App& command, std::optional<double>& speed,
                              const std::string& otherwise, const std::string& names = "--speed");

}  // namespace tagfield
