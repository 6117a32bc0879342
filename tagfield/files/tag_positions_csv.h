// SPDX-License-Identifier: Apache-2.0
/// @file
/// Positions of tags, such as those measured for reference tags, as CSV: `tag,x_m,y_m,z_m`.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

namespace tagfield {

/// Text of the table; positions by tag ID [m, world].
std::string tag_positions_to_csv(const std::map<std::string, Eigen::Vector3d>& places);

/// Reads the table. Throws Error "FILE:LINE: …", also on a tag that is listed twice.
std::map<std::string, Eigen::Vector3d> read_tag_positions_csv(const std::string& path);

}  // namespace tagfield
