// SPDX-License-Identifier: Apache-2.0
/// @file
/// Many tags at rest as a CSV table.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Reads `tag,x_m,y_m,z_m`, a row a tag, and where the columns are there its orientation,
/// `roll_rad,pitch_rad,yaw_rad` (all three), and its kind, `profile`: a shipped profile's name, or
/// a file relative to the table; empty for `otherwise`. Throws Error "FILE:LINE: …".
std::vector<TagSpec> read_tag_table(const std::string& path,
                                    const std::shared_ptr<const TagModel>& otherwise,
                                    Diagnostics& diagnostics);

}  // namespace tagfield
