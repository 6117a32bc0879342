// SPDX-License-Identifier: Apache-2.0
/// @file
/// Maps as ROS' map server reads and writes them: a YAML file that names a PGM image.
#pragma once

#include <string>

#include "tagfield/base/error.h"
#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// The image (binary PGM): 254 free, 0 occupied, 205 unknown or in between, as map_saver writes
/// them in its trinary mode; its first row is the map's last.
std::string map_to_pgm(const OccupancyGrid& grid);
/// The YAML beside it: image, resolution, origin [x, y, yaw], negate, occupied_thresh, free_thresh.
/// With these, free, occupied and unknown cells come back as they were.
std::string map_to_yaml(const OccupancyGrid& grid, const std::string& image);

/// Reads both. P5 and P2 images of 8 or 16 bits, `negate`, and the modes trinary, scale and raw are
/// understood; docs/map.md says how a grey becomes a cell. Unknown keys are warned of. The image's
/// path is relative to the YAML. Throws Error with file and line or byte on: a missing, empty or
/// torn file, a size that the file's bytes don't bear out, a grey above the image's own greatest, a
/// resolution that is not positive, thresholds out of order, a yaw of the origin other than 0
/// (which no cell-aligned grid can hold). Takes no more memory than a few times what the files are
/// long.
OccupancyGrid read_map(const std::string& yaml_path, Diagnostics& diagnostics);

}  // namespace tagfield
