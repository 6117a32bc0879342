// SPDX-License-Identifier: Apache-2.0
/// @file
/// Civil time of a simulation's stamps.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tagfield/base/time.h"

namespace tagfield {

/// Adds `--start`.
void add_start_option(CLI::App& command, std::string& start);

/// Time since 1970 at stamp 0: the value of `--start`, or 2020-01-01T00:00:00Z by default, but 0 if
/// the first stamp is already Unix time (after 2001-09-09). Throws Error "COMMAND: --start: …".
Time start_time(const std::string& command, const std::string& start, Time first_stamp);

}  // namespace tagfield
