// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_unit.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "tagfield/base/units.h"
#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Antennas' paths over which the distance to a tag changes by more than half a wavelength, as far
/// as tags are read [m].
constexpr double kLongPath = 2.0;
/// In the middle of a circle, all phases of one tag are the same.
constexpr std::size_t kFewestTags = 2;
constexpr std::size_t kEnoughReads = 100;
constexpr std::size_t kParts = 64;

using Parts = std::array<bool, kParts>;

std::size_t part_of(double phase_rad) {
  const double share = wrap_to_two_pi(phase_rad) / kTwoPi;
  return std::min(static_cast<std::size_t>(share * static_cast<double>(kParts)), kParts - 1);
}

std::size_t longest_gap(const Parts& parts) {
  std::size_t longest = 0;
  std::size_t gap = 0;
  // Twice around, so that a gap across 0 is seen in one piece.
  for (std::size_t i = 0; i < 2 * kParts; ++i) {
    gap = parts[i % kParts] ? 0 : gap + 1;
    longest = std::max(longest, gap);
  }
  return std::min(longest, kParts);
}

}  // namespace

double occupied_cycle(const SamplesByTag& samples) {
  Parts parts{};
  std::size_t tags = 0;
  std::size_t reads = 0;
  for (const auto& [tag, of_tag] : samples) {
    bool is_long = false;
    for (const auto& [antenna, series] : of_tag) {
      if (extent_of(series) < kLongPath) continue;
      is_long = true;
      reads += series.size();
      for (const PhaseSample& sample : series) parts[part_of(sample.phase_rad)] = true;
    }
    if (is_long) ++tags;
  }
  if (tags < kFewestTags || reads < kEnoughReads) return 1.0;
  return static_cast<double>(kParts - longest_gap(parts)) / static_cast<double>(kParts);
}

}  // namespace tagfield
