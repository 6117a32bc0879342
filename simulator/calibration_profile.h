/// @file
/// Calibrations as profiles: YAML files.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "tagfield/calibration/calibration.h"

namespace tagfield {

/// Reads what to_yaml(Calibration) wrote, or a person. Throws Error "FILE:LINE: …".
Calibration read_calibration(const std::string& path);

/// Reads places of tags: `tag,x_m,y_m,z_m` [m, world]. Throws Error "FILE:LINE: …", also on a tag
/// that stands there twice.
std::map<std::string, Eigen::Vector3d> read_tag_places_csv(const std::string& path);

}  // namespace tagfield
