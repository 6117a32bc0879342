// SPDX-License-Identifier: Apache-2.0
/// @file
/// Waves of many reads added up at many places: the inner loop of all holograms.
#pragma once

#include <cstddef>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/holograms/grid_search.h"

namespace tagfield {

/// A read in single precision, relative to the middle of what is searched.
struct SearchRead {
  float x = 0.0f, y = 0.0f;      ///< Antenna [m].
  float z = 0.0f;                ///< Antenna above the plane that is searched [m].
  float height_squared = 0.0f;   ///< z² [m²].
  float turns = 0.0f;            ///< Phase, in turns, within [−½, ½].
  float turns_per_metre = 0.0f;  ///< 2/λ.
};

/// The reads that one level of a search looks at.
struct SearchReads {
  std::vector<SearchRead> reads;
  std::vector<Aperture> apertures;  ///< Of `reads`.
};

/// Cosine and sine of 2π `turns`, |turns| < 2²², to 2·10⁻⁵: those of π times what is left of whole
/// turns by polynomials that meet them at Chebyshev's points, then the double angle. For loops over
/// lanes.
inline void wave_of(float turns, float& cosine, float& sine) {
  // Added to a number of this size, fractions are rounded off.
  constexpr float kRounds = 12582912.0f;  // 1.5 · 2²³
  const float t = turns - ((turns + kRounds) - kRounds);
  const float u = t * t;
  const float s = t * (3.1415903f + u * (-5.1674058f + u * (2.5440002f - u * 0.5594350f)));
  const float c = 0.9999932f + u * (-4.9339313f + u * (4.0412123f - u * 1.2219364f));
  cosine = 1.0f - 2.0f * (s * s);
  sine = 2.0f * s * c;
}

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

/// What the sums of the apertures add up to: their amplitudes, or Σ cos where the offset is known.
/// At the places (x, y) of the plane that is searched [m]. The same to the last bit for each set of
/// instructions.
Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y,
                     InstructionSet set = instruction_sets().back());

/// The same, at places (x, y, z) with z relative to that plane.
Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z,
                     InstructionSet set = instruction_sets().back());

}  // namespace tagfield
