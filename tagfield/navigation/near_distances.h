// SPDX-License-Identifier: Apache-2.0
/// @file
/// Distance transform for short distances, fast enough for many calls a second.
#pragma once

#include <cstdint>
#include <vector>

namespace tagfield {

/// The distance from each cell of a grid of `width` to the nearest source cell (not 0), centre to
/// centre, in cells, capped at `max_cells`. Exact: along the columns first, then along the rows by
/// trying all offsets up to `max_cells`, which for a few dozen is several times as fast as
/// distance_field(), since it has no branches. `sources` is in row-major order, its size a multiple
/// of `width` > 0; 1 ≤ max_cells ≤ 180.
std::vector<float> near_distances(const std::vector<std::uint8_t>& sources, int width,
                                  int max_cells);

/// Number of cells of `resolution_m` that cover `distance_m` and one cell more, within the limits
/// of near_distances().
int cells_for(double distance_m, double resolution_m);

}  // namespace tagfield
