// SPDX-License-Identifier: Apache-2.0
/// @file
/// Output of `tagfield --version`.
#pragma once

#include <string>

#include "apps/tagfield/build_info.h"

namespace tagfield {

/// "tagfield 0.1.0", followed by lines about the build.
std::string version_text(const BuildInfo& build);
/// Same, machine-readable.
std::string version_json(const BuildInfo& build);

}  // namespace tagfield
