// SPDX-License-Identifier: Apache-2.0
/// @file
/// Protection of one scenario's results from being overwritten by another's.
#pragma once

#include <string>

namespace tagfield {

/// Throws Error if `folder` contains results of a scenario with another name, unless `force` is
/// set.
void require_own_folder(const std::string& folder, const std::string& scenario, bool force);

}  // namespace tagfield
