// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `tagfield` alone prints.
#pragma once

#include <string>

namespace tagfield {

/// What to do next, for somebody who has just installed it.
std::string first_steps();

}  // namespace tagfield
