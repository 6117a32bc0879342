// SPDX-License-Identifier: Apache-2.0
/// @file
/// Synthetic reads of a hologram search, for the tests of phasor sums.
#pragma once

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "made_reads.h"
#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield::made {

inline float some(Rng& rng, double most) { return static_cast<float>(uniform(rng, -most, most)); }

/// 1 to `most` random reads, of antennas within 9 m of the middle, at 866 MHz.
inline std::vector<SearchRead> search_reads(Rng& rng, std::size_t most) {
  std::vector<SearchRead> reads(1 + rng() % most);
  for (SearchRead& read : reads) {
    read = {some(rng, 9.0), some(rng, 9.0), some(rng, 2.0), 0.0f, some(rng, 0.5), 5.775f};
    read.height_squared = read.z * read.z;
  }
  return reads;
}

/// The reads divided into apertures of one to nine, of which some have a known offset.
inline SearchReads with_apertures(Rng& rng, std::vector<SearchRead> reads) {
  SearchReads all;
  all.reads = std::move(reads);
  const auto count = static_cast<Eigen::Index>(all.reads.size());
  for (Eigen::Index begin = 0; begin < count; begin += all.apertures.back().count) {
    const auto length = static_cast<Eigen::Index>(1 + rng() % 9);
    all.apertures.push_back({begin, std::min(length, count - begin), rng() % 3 == 0});
  }
  return all;
}

/// Contribution of an aperture to the amplitude at a position.
inline float amplitude(const Aperture& aperture, float in_phase, float quadrature) {
  if (aperture.offset_known) return in_phase;
  return std::sqrt(in_phase * in_phase + quadrature * quadrature);
}

}  // namespace tagfield::made
