// SPDX-License-Identifier: Apache-2.0
/// @file
/// What --json of a command prints where its result is files or an address.
#pragma once

#include <nlohmann/json.hpp>

namespace tagfield {

/// On a line of standard output. What is no UTF-8 in it, as a file's name may be, is replaced.
void print_json_line(const nlohmann::ordered_json& json);

}  // namespace tagfield
