// SPDX-License-Identifier: Apache-2.0
/// @file
/// Results of one scenario don't replace those of another.
#pragma once

#include <string>

namespace tagfield {

/// Throws Error where `folder` holds results of a scenario of another name, unless `force` is set.
void require_own_folder(const std::string& folder, const std::string& scenario, bool force);

}  // namespace tagfield
