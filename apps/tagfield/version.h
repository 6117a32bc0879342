// SPDX-License-Identifier: Apache-2.0
/// @file
/// What `tagfield --version` prints.
#pragma once

#include <string>

#include "apps/tagfield/build_info.h"

namespace tagfield {

/// "tagfield 0.1.0" and, in lines below it, what it was built from, and with.
std::string version_text(const BuildInfo& build);
/// The same for machines.
std::string version_json(const BuildInfo& build);

}  // namespace tagfield
