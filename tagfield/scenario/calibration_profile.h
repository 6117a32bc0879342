// SPDX-License-Identifier: Apache-2.0
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

}  // namespace tagfield
