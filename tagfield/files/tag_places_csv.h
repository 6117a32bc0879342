// SPDX-License-Identifier: Apache-2.0
/// @file
/// Places of tags, as measured of reference tags, as CSV: `tag,x_m,y_m,z_m`.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

namespace tagfield {

/// Text of the table; places by tag ID [m, world].
std::string tag_places_to_csv(const std::map<std::string, Eigen::Vector3d>& places);

/// Reads the table. Throws Error "FILE:LINE: …", also on a tag that stands there twice.
std::map<std::string, Eigen::Vector3d> read_tag_places_csv(const std::string& path);

}  // namespace tagfield
