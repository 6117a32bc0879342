// SPDX-License-Identifier: Apache-2.0
/// @file
/// Stationary tags as a CSV table.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Reads `tag,x_m,y_m,z_m`, one row per tag, and, if the columns exist, the orientation
/// `roll_rad,pitch_rad,yaw_rad` (all three) and the kind `profile`: a shipped profile's name, or a
/// file relative to the table; empty for `otherwise`. Throws Error "FILE:LINE: …".
std::vector<TagSpec> read_tag_table(const std::string& path,
                                    const std::shared_ptr<const TagModel>& otherwise,
                                    Diagnostics& diagnostics);

}  // namespace tagfield
