// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_sums.h"

#include <cmath>

#include "tagfield/base/lanes.h"

namespace tagfield {
namespace {

constexpr int kLanes = 16;  ///< Places whose sums stay in registers.
static_assert(kTile % kLanes == 0);

/// `z` is null for places of the plane.
inline void add_waves(const SearchRead* reads, std::size_t count, const float* x, const float* y,
                      const float* z, float* in_phase, float* quadrature) {
  float cosines[kLanes] = {};
  float sines[kLanes] = {};
  for (std::size_t i = 0; i < count; ++i) {
    const SearchRead& read = reads[i];
    for (int k = 0; k < kLanes; ++k) {
      const float dx = x[k] - read.x;
      const float dy = y[k] - read.y;
      const float dz = z != nullptr ? z[k] - read.z : 0.0f;
      const float rest = z != nullptr ? dz * dz : read.height_squared;
      const float turns = read.turns - read.turns_per_metre * std::sqrt(dx * dx + dy * dy + rest);
      float cosine = 0.0f;
      float sine = 0.0f;
      wave_of(turns, cosine, sine);
      cosines[k] += cosine;
      sines[k] += sine;
    }
  }
  for (int k = 0; k < kLanes; ++k) {
    in_phase[k] = cosines[k];
    quadrature[k] = sines[k];
  }
}

/// Of kLanes places.
inline void add_amplitudes(const SearchReads& reads, const float* x, const float* y, const float* z,
                           float* sum) {
  float amplitudes[kLanes] = {};
  for (const Aperture& aperture : reads.apertures) {
    float in_phase[kLanes];
    float quadrature[kLanes];
    add_waves(reads.reads.data() + aperture.begin, static_cast<std::size_t>(aperture.count), x, y,
              z, in_phase, quadrature);
    if (aperture.offset_known) {
      for (int k = 0; k < kLanes; ++k) amplitudes[k] += in_phase[k];
    } else {
      for (int k = 0; k < kLanes; ++k) {
        amplitudes[k] += std::sqrt(in_phase[k] * in_phase[k] + quadrature[k] * quadrature[k]);
      }
    }
  }
  for (int k = 0; k < kLanes; ++k) sum[k] = amplitudes[k];
}

}  // namespace

WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   InstructionSet set) {
  WaveSums sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kLanes) {
      add_waves(reads, count, x.data() + k, y.data() + k, nullptr, sums.in_phase.data() + k,
                sums.quadrature.data() + k);
    }
  });
  return sums;
}

WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   const Tile& z, InstructionSet set) {
  WaveSums sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kLanes) {
      add_waves(reads, count, x.data() + k, y.data() + k, z.data() + k, sums.in_phase.data() + k,
                sums.quadrature.data() + k);
    }
  });
  return sums;
}

Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, InstructionSet set) {
  Tile sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kLanes) {
      add_amplitudes(reads, x.data() + k, y.data() + k, nullptr, sums.data() + k);
    }
  });
  return sums;
}

Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z,
                     InstructionSet set) {
  Tile sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kLanes) {
      add_amplitudes(reads, x.data() + k, y.data() + k, z.data() + k, sums.data() + k);
    }
  });
  return sums;
}

}  // namespace tagfield
