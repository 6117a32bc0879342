// SPDX-License-Identifier: Apache-2.0
/// @file
/// --speed, which means the same in all commands.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

namespace tagfield {

/// Adds it under `names`: a multiple of real time up to 1e6; 0, for which "max" can be written,
/// means as fast as possible. `otherwise` describes the default.
CLI::Option* add_speed_option(CLI::App& command, std::optional<double>& speed,
                              const std::string& otherwise, const std::string& names = "--speed");

}  // namespace tagfield
