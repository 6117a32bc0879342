// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phasors of reads at the points of some lanes, only for loops in lanes (base/lanes.h).
#pragma once

#include <cmath>
#include <cstddef>
#include <cstring>

#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield {

/// Number of points whose sums stay in registers.
inline constexpr int kWaveLanes = 16;
static_assert(kTile % kWaveLanes == 0);

/// A row of such points, which compilers keep in as few registers as possible.
using LaneRow = float __attribute__((vector_size(kWaveLanes * sizeof(float))));

inline void load(const float* from, LaneRow& row) { std::memcpy(&row, from, sizeof row); }
inline void store(const LaneRow& row, float* to) { std::memcpy(to, &row, sizeof row); }

/// Σ cos and Σ sin of the residuals of `count` reads, as in WaveSums. `z` is ignored for points in
/// the plane.
template <bool in_space>
inline void add_waves(const SearchRead* reads, std::size_t count, const float* x, const float* y,
                      const float* z, float* in_phase, float* quadrature) {
  float cosines[kWaveLanes] = {};
  float sines[kWaveLanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const SearchRead& read = reads[i];
    for (int k = 0; k < kWaveLanes; ++k) {
      const float dx = x[k] - read.x;
      const float dy = y[k] - read.y;
      float rest = read.height_squared;
      if constexpr (in_space) rest = (z[k] - read.z) * (z[k] - read.z);
      const float turns = read.turns - read.turns_per_metre * std::sqrt(dx * dx + dy * dy + rest);
      float cosine = 0.0f;
      float sine = 0.0f;
      wave_of(turns, cosine, sine);
      cosines[k] += cosine;
      sines[k] += sine;
    }
  }
  for (int k = 0; k < kWaveLanes; ++k) {
    in_phase[k] = cosines[k];
    quadrature[k] = sines[k];
  }
}

}  // namespace tagfield
