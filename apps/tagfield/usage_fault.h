// SPDX-License-Identifier: Apache-2.0
/// @file
/// Helpful one-line messages for invalid command lines.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tagfield {

/// One line about a command line that `app` could not parse: for a command or option that does not
/// exist, the most similar one; otherwise `what` CLI11 reports, and the --help to consult.
std::string usage_fault(const CLI::App& app, const std::string& what);

}  // namespace tagfield
