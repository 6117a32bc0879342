// SPDX-License-Identifier: Apache-2.0
/// @file
/// Waves of many reads added up at many places: the inner loop of all holograms.
#pragma once

#include <cstddef>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/grid_search.h"

namespace tagfield {

/// A read in single precision, relative to `SearchReads::middle`.
struct SearchRead {
  float x = 0.0f, y = 0.0f;      ///< Antenna [m].
  float z = 0.0f;                ///< Antenna above the plane that is searched [m].
  float height_squared = 0.0f;   ///< z² [m²].
  float turns = 0.0f;            ///< Phase, in turns, within [−½, ½].
  float turns_per_metre = 0.0f;  ///< 2/λ.
};

/// Σ cos and Σ sin of the residuals φ − 2r/λ at each place of a tile.
struct WaveSums {
  Tile in_phase = Tile::Zero();
  Tile quadrature = Tile::Zero();
};

/// Of `count` reads, at the places (x, y) of the plane that is searched [m]. The same to the last
/// bit for each set of instructions; each wave to 2·10⁻⁵, |φ − 2r/λ| < 2²² turns.
WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   InstructionSet set = instruction_sets().back());

/// The same, at places (x, y, z) with z relative to that plane.
WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   const Tile& z, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
