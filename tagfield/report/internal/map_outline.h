// SPDX-License-Identifier: Apache-2.0
/// @file
/// Grid maps as outlines of regions, which keep a drawing small.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "tagfield/map/occupancy_grid.h"

namespace tagfield {

/// Outline of all cells for which `belongs` is true, as SVG path data for fill-rule evenodd, in
/// units of cells: x and y are those of the map (y upwards), (0, 0) is the outer corner of cell (0,
/// 0). "" if there are no such cells.
std::string cell_outline(const OccupancyGrid& grid,
                         const std::function<bool(std::int8_t)>& belongs);

/// The grid with `step`×`step` cells merged into one, 1 ≤ step: occupied (100) if any is, else free
/// (0) if any is, else unknown (-1).
OccupancyGrid coarsened(const OccupancyGrid& grid, int step);

}  // namespace tagfield
