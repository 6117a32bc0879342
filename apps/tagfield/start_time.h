// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which civil time a simulation's stamps are.
#pragma once

#include <CLI/CLI.hpp>
#include <optional>
#include <string>

#include "tagfield/base/time.h"

namespace tagfield {

/// Adds `--start`.
void add_start_option(CLI::App& command, std::string& start);

/// Time since 1970 at stamp 0: what `--start` says, or else 2020-01-01T00:00:00Z, but 0 where the
/// first stamp is Unix time already (later than 2001-09-09). Throws Error "COMMAND: --start: …".
Time start_time(const std::string& command, const std::string& start, Time first_stamp);

}  // namespace tagfield
