// SPDX-License-Identifier: Apache-2.0
/// @file
/// What is wrong with a command line, in one line that helps.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tagfield {

/// One line about a command line that `app` could not parse: a command or option that does not
/// exist, with the nearest that does; else `what` CLI11 says, and whose --help tells more.
std::string usage_fault(const CLI::App& app, const std::string& what);

}  // namespace tagfield
