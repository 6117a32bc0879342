// SPDX-License-Identifier: Apache-2.0
/// @file
/// --json, which means the same in all commands.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace tagfield {

/// Adds --json: the same results, written to the same files, are printed as JSON. `form` describes
/// the JSON: "summary.json", "{\"page\": FILE}"; "" if there is nothing to add.
CLI::Option* add_json_option(CLI::App& command, bool& as_json, const std::string& form = "");

}  // namespace tagfield
