// SPDX-License-Identifier: Apache-2.0
/// @file
/// Output of --json for commands whose result is files or an address.
#pragma once

#include <nlohmann/json.hpp>

namespace tagfield {

/// Prints JSON as a line of standard output. Invalid UTF-8 in it, for example in file names, is
/// replaced.
void print_json_line(const nlohmann::ordered_json& json);

}  // namespace tagfield
