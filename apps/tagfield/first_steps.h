// SPDX-License-Identifier: Apache-2.0
/// @file
/// Output of `tagfield` without arguments.
#pragma once

#include <string>

namespace tagfield {

/// Next steps for a new user.
std::string first_steps();

}  // namespace tagfield
