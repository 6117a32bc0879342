// SPDX-License-Identifier: Apache-2.0
/// @file
/// Distances to what is near, many times a second.
#pragma once

#include <cstdint>
#include <vector>

namespace tagfield {

/// The distance from each cell of a grid of `width` to the nearest cell that is a source (not 0),
/// centre to centre, in cells; at most `most_cells` and `most_cells` where there is none as near.
/// Exact: along the columns first, then along the rows by trying all offsets up to `most_cells`,
/// which for a few dozen is several times as fast as distance_field(), having no branches.
/// `sources` is row by row, its size a multiple of `width` > 0; 1 ≤ most_cells ≤ 180.
std::vector<float> near_distances(const std::vector<std::uint8_t>& sources, int width,
                                  int most_cells);

/// How many cells of `resolution_m` to look so far as `distance_m` and a cell beyond, within what
/// near_distances() takes.
int cells_for(double distance_m, double resolution_m);

}  // namespace tagfield
