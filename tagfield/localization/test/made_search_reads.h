// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads by which holograms search, made up, for the tests of sums of waves.
#pragma once

#include <vector>

#include "made_reads.h"
#include "tagfield/localization/holograms/wave_sums.h"

namespace tagfield::made {

inline float some(Rng& rng, double most) { return static_cast<float>(uniform(rng, -most, most)); }

/// Some up to `most`, of antennas within 9 m of the middle, at 866 MHz.
inline std::vector<SearchRead> search_reads(Rng& rng, std::size_t most) {
  std::vector<SearchRead> reads(1 + rng() % most);
  for (SearchRead& read : reads) {
    read = {some(rng, 9.0), some(rng, 9.0), some(rng, 2.0), 0.0f, some(rng, 0.5), 5.775f};
    read.height_squared = read.z * read.z;
  }
  return reads;
}

}  // namespace tagfield::made
