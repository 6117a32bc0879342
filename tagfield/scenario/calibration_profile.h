// SPDX-License-Identifier: Apache-2.0
/// @file
/// Calibrations as profiles: YAML files.
#pragma once

#include <Eigen/Core>
#include <map>
#include <string>

#include "tagfield/calibration/calibration.h"

namespace tagfield {

/// Reads a calibration written by to_yaml(Calibration) or by hand. Throws Error "FILE:LINE: …".
Calibration read_calibration(const std::string& path);

}  // namespace tagfield
