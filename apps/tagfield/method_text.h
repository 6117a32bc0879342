// SPDX-License-Identifier: Apache-2.0
/// @file
/// Description of the methods for people.
#pragma once

#include <string>

namespace tagfield {

/// Name and summary of each method on a line, followed by a line for each of its settings.
std::string methods_help();

}  // namespace tagfield
