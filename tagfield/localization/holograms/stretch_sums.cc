// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/stretch_sums.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "tagfield/base/lane_math.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/wave_lanes.h"

namespace tagfield {
namespace {

/// Sums of a piece's waves.
struct PieceLanes {
  float in_phase[kWaveLanes];
  float quadrature[kWaveLanes];
};

std::vector<std::size_t> pieces_in(const std::vector<const CoherentStretch*>& stretches,
                                   std::size_t count) {
  std::vector<char> is_in(count, 0);
  for (const CoherentStretch* stretch : stretches) {
    for (const auto& channel : stretch->channels) {
      for (const std::size_t piece : channel) is_in[piece] = 1;
    }
  }
  std::vector<std::size_t> pieces;
  for (std::size_t piece = 0; piece < count; ++piece) {
    if (is_in[piece] != 0) pieces.push_back(piece);
  }
  return pieces;
}

/// |S_c|² of a channel over its reads and over all of the stretch.
inline void add_share(const SearchReads& reads, const std::vector<std::size_t>& channel,
                      float of_stretch, const PieceLanes* pieces, float* share) {
  float in_phase[kWaveLanes] = {};
  float quadrature[kWaveLanes] = {};
  float count = 0.0f;
  for (const std::size_t piece : channel) {
    for (int k = 0; k < kWaveLanes; ++k) in_phase[k] += pieces[piece].in_phase[k];
    for (int k = 0; k < kWaveLanes; ++k) quadrature[k] += pieces[piece].quadrature[k];
    count += static_cast<float>(reads.apertures[piece].count);
  }
  const float each = 1.0f / (count * of_stretch);
  for (int k = 0; k < kWaveLanes; ++k) {
    share[k] += each * (in_phase[k] * in_phase[k] + quadrature[k] * quadrature[k]);
  }
}

inline void add_stretch(const SearchReads& reads, const CoherentStretch& stretch,
                        const PieceLanes* pieces, float* sum) {
  float share[kWaveLanes] = {};
  for (const std::vector<std::size_t>& channel : stretch.channels) {
    add_share(reads, channel, stretch.reads, pieces, share);
  }
  for (int k = 0; k < kWaveLanes; ++k) {
    const float left = std::max(1.0f - share[k], kLeastLeft);
    sum[k] -= stretch.freedom * lane_log(left);
  }
}

}  // namespace

Tile stretch_sums(const SearchReads& reads, const std::vector<const CoherentStretch*>& stretches,
                  const Tile& x, const Tile& y, const Tile& z, InstructionSet set) {
  const std::vector<std::size_t> used = pieces_in(stretches, reads.apertures.size());
  std::vector<PieceLanes> pieces(reads.apertures.size());
  Tile sums;
  in_lanes(set, [&] {
    for (int first = 0; first < kTile; first += kWaveLanes) {
      for (const std::size_t i : used) {
        const Aperture& piece = reads.apertures[i];
        add_waves(reads.reads.data() + piece.begin, static_cast<std::size_t>(piece.count),
                  x.data() + first, y.data() + first, z.data() + first, pieces[i].in_phase,
                  pieces[i].quadrature);
      }
      float sum[kWaveLanes] = {};
      for (const CoherentStretch* stretch : stretches) {
        add_stretch(reads, *stretch, pieces.data(), sum);
      }
      for (int k = 0; k < kWaveLanes; ++k) sums.data()[first + k] = sum[k];
    }
  });
  return sums;
}

double independent_samples(const std::vector<double>& along_m, double wavelength,
                           InstructionSet set) {
  if (along_m.empty()) return 0.0;
  constexpr std::size_t kLanes = 8;
  constexpr double kNear = 1e-6;  // sinc is 1 there.
  const std::size_t count = along_m.size();
  const std::size_t whole = (count + kLanes - 1) / kLanes * kLanes;
  std::vector<double> angles(whole, 0.0);
  std::vector<double> sines(whole, 0.0);
  std::vector<double> cosines(whole, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    angles[i] = kPi / wavelength * along_m[i];
    sines[i] = std::sin(angles[i]);
    cosines[i] = std::cos(angles[i]);
  }
  double pairs[kLanes] = {};
  in_lanes(set, [&] {
    for (std::size_t i = 1; i < count; ++i) {
      const double angle = angles[i];
      const double sine = sines[i];
      const double cosine = cosines[i];
      for (std::size_t first = 0; first < i; first += kLanes) {
        for (std::size_t k = 0; k < kLanes; ++k) {
          const std::size_t j = first + k;
          const double apart = angle - angles[j];
          // sin(a − b) by those of a and b.
          const double sinc = (sine * cosines[j] - cosine * sines[j]) / apart;
          const double square = choose(std::abs(apart) < kNear, 1.0, sinc * sinc);
          pairs[k] += choose(j < i, square, 0.0);
        }
      }
    }
  });
  const double all = static_cast<double>(count) + 2.0 * std::accumulate(pairs, pairs + kLanes, 0.0);
  return static_cast<double>(count) * static_cast<double>(count) / all;
}

}  // namespace tagfield
