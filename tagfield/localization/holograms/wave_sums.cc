// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/wave_sums.h"

#include <cmath>

#include "tagfield/base/lanes.h"
#include "tagfield/localization/holograms/wave_lanes.h"

namespace tagfield {
namespace {

/// Amplitudes at kWaveLanes points.
template <bool in_space>
inline void add_amplitudes(const SearchReads& reads, const float* x, const float* y, const float* z,
                           float* sum) {
  float amplitudes[kWaveLanes] = {};
  for (const Aperture& aperture : reads.apertures) {
    float in_phase[kWaveLanes];
    float quadrature[kWaveLanes];
    add_waves<in_space>(reads.reads.data() + aperture.begin,
                        static_cast<std::size_t>(aperture.count), x, y, z, in_phase, quadrature);
    if (aperture.offset_known) {
      for (int k = 0; k < kWaveLanes; ++k) amplitudes[k] += in_phase[k];
    } else {
      for (int k = 0; k < kWaveLanes; ++k) {
        amplitudes[k] += std::sqrt(in_phase[k] * in_phase[k] + quadrature[k] * quadrature[k]);
      }
    }
  }
  for (int k = 0; k < kWaveLanes; ++k) sum[k] = amplitudes[k];
}

}  // namespace

WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   InstructionSet set) {
  WaveSums sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kWaveLanes) {
      add_waves<false>(reads, count, x.data() + k, y.data() + k, nullptr, sums.in_phase.data() + k,
                       sums.quadrature.data() + k);
    }
  });
  return sums;
}

WaveSums wave_sums(const SearchRead* reads, std::size_t count, const Tile& x, const Tile& y,
                   const Tile& z, InstructionSet set) {
  WaveSums sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kWaveLanes) {
      add_waves<true>(reads, count, x.data() + k, y.data() + k, z.data() + k,
                      sums.in_phase.data() + k, sums.quadrature.data() + k);
    }
  });
  return sums;
}

Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, InstructionSet set) {
  Tile sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kWaveLanes) {
      add_amplitudes<false>(reads, x.data() + k, y.data() + k, nullptr, sums.data() + k);
    }
  });
  return sums;
}

Tile wave_amplitudes(const SearchReads& reads, const Tile& x, const Tile& y, const Tile& z,
                     InstructionSet set) {
  Tile sums;
  in_lanes(set, [&] {
    for (int k = 0; k < kTile; k += kWaveLanes) {
      add_amplitudes<true>(reads, x.data() + k, y.data() + k, z.data() + k, sums.data() + k);
    }
  });
  return sums;
}

}  // namespace tagfield
