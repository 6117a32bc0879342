// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phasor sums of many reads at many points: the inner loop of all holograms.
#pragma once

#include <cstddef>
#include <vector>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/coherent_reads.h"
#include "tagfield/localization/holograms/grid_search.h"

namespace tagfield {

/// A read in single precision, relative to the middle of the searched area.
struct SearchRead {
  float x = 0.0f, y = 0.0f;      ///< Antenna [m].
  float z = 0.0f;                ///< Antenna above the searched plane [m].
  float height_squared = 0.0f;   ///< z² [m²].
  float turns = 0.0f;            ///< Phase, in turns, within [−½, ½].
  float turns_per_metre = 0.0f;  ///< 2/λ.
};

/// The reads used by one level of a search.
struct SearchReads {
  std::vector<SearchRead> reads;
  std::vector<Aperture> apertures;  ///< Of `reads`.
};

/// `turns` wrapped to [−½, ½]; |turns| < 2²². For loops over lanes.
inline float wrapped_turns(float turns) {
  // Adding a number of this size rounds fractions off.
  constexpr float kRounds = 12582912.0f;  // 1.5 · 2²³
  return turns - ((turns + kRounds) - kRounds);
}

/// Cosine and sine of 2πt, |t| ≤ ½, to 2·10⁻⁵: polynomials for the half angle, interpolated at
/// Chebyshev nodes, then the double-angle formulas. For loops over lanes.
inline void wrapped_wave_of(float t, float& cosine, float& sine) {
  const float u = t * t;
  const float s = t * (3.1415903f + u * (-5.1674058f + u * (2.5440002f - u * 0.5594350f)));
  const float c = 0.9999932f + u * (-4.9339313f + u * (4.0412123f - u * 1.2219364f));
  cosine = 1.0f - 2.0f * (s * s);
  sine = 2.0f * s * c;
}

/// Cosine and sine of 2π `turns`, |turns| < 2²², to 2·10⁻⁵. For loops over lanes.
inline void wave_of(float turns, float& cosine, float& sine) {
  wrapped_wave_of(wrapped_turns(turns), cosine, sine);
}

/// Σ cos and Σ sin of the residuals φ − 2r/λ at each point of a tile.
struct WaveSums {
  Tile in_phase = Tile::Zero();
  Tile quadrature = Tile::Zero();
};

/// Sums over `count` reads at the points (x, y) of the searched plane [m]. Bit-identical for every
/// instruction set; each phasor to 2·10⁻⁵, |φ − 2r/λ| < 2²² turns.
WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   InstructionSet set = instruction_sets().back());

/// As above, at points (x, y, z) with z relative to that plane.
WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   const Tile& z, InstructionSet set = instruction_sets().back());

/// Total over the apertures of their amplitudes, or of Σ cos where the offset is known, at the
/// points (x, y) of the searched plane [m]. Bit-identical for every instruction set.
Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y,
                     InstructionSet set = instruction_sets().back());

/// As above, at points (x, y, z) with z relative to that plane.
Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z,
                     InstructionSet set = instruction_sets().back());

}  // namespace tagfield
