// SPDX-License-Identifier: Apache-2.0
/// @file
/// Map files in the format of ROS's map server: a YAML file that refers to a PGM image.
#pragma once

#include <string>

#include "tagfield/base/error.h"
#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// The image (binary PGM): 254 free, 0 occupied, 205 unknown or in between, as written by map_saver
/// in trinary mode; its first row is the map's last.
std::string map_to_pgm(const OccupancyGrid& grid);
/// The YAML file for it: image, resolution, origin [x, y, yaw], negate, occupied_thresh,
/// free_thresh. With these, free, occupied and unknown cells are restored on reading.
std::string map_to_yaml(const OccupancyGrid& grid, const std::string& image);

/// Reads both files. Supports P5 and P2 images of 8 or 16 bits, `negate`, and the modes trinary,
/// scale and raw; docs/map.md describes how a grey value becomes a cell. Warns of unknown keys. The
/// image's path is relative to the YAML file. Throws Error with file and line or byte on: a
/// missing, empty or truncated file, an image size that does not match the file's size, a grey
/// value above the image's maximum, a resolution that is not positive, thresholds out of order, a
/// yaw of the origin other than 0 (which a cell-aligned grid cannot represent). Memory use is
/// limited to a few times the size of the files.
OccupancyGrid read_map(const std::string& yaml_path, Diagnostics& diagnostics);

}  // namespace tagfield
