// SPDX-License-Identifier: Apache-2.0
/// @file
/// Known heights of tags, such as from the racks that they are on, as CSV: `tag,height_m`.
#pragma once

#include <map>
#include <string>

namespace tagfield {

/// Text of the table; heights by tag ID [m, world].
std::string tag_heights_to_csv(const std::map<std::string, double>& heights);

/// Reads the table. Throws Error "FILE:LINE: …", also on a tag that is listed twice.
std::map<std::string, double> read_tag_heights_csv(const std::string& path);

}  // namespace tagfield
