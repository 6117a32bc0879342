// SPDX-License-Identifier: Apache-2.0
/// @file
/// Maps of cells as the outlines of what they hold, which a drawing carries lightly.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// Outline of all cells that belong, as SVG path data for fill-rule evenodd, in cells: x as the
/// map's x, y as its y (upwards), (0, 0) the outer corner of cell (0, 0). "" where none does.
std::string cell_outline(const OccupancyGrid& grid,
                         const std::function<bool(std::int8_t)>& belongs);

/// `step`×`step` cells as one, 1 ≤ step: occupied (100) where any is, else free (0) where any is,
/// else unknown (-1).
OccupancyGrid coarsened(const OccupancyGrid& grid, int step);

}  // namespace tagfield
