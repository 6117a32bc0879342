// SPDX-License-Identifier: Apache-2.0
/// @file
/// What people are told of the methods.
#pragma once

#include <string>

namespace tagfield {

/// Name and summary of each, a line each, and below it a line for each of its settings.
std::string told_of_methods();

}  // namespace tagfield
