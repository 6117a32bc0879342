// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/strays.h"

#include <algorithm>
#include <chrono>

#include "tagfield/localization/judgement.h"

namespace tagfield {
namespace {

/// Clocks are off by time zones or epochs.
constexpr Duration kMinPause = std::chrono::hours(1);
constexpr std::size_t kRowsToAStray = 100;

using Stamp = std::vector<Time>::const_iterator;

/// First stamp after the longest pause.
Stamp after_longest_pause(Stamp begin, Stamp end) {
  Stamp longest = begin + 1;
  for (Stamp at = begin + 1; at != end; ++at) {
    if (*at - *(at - 1) > *longest - *(longest - 1)) longest = at;
  }
  return longest;
}

}  // namespace

StampRange range_without_strays(std::vector<Time> stamps) {
  std::sort(stamps.begin(), stamps.end());
  Stamp begin = stamps.begin();
  Stamp end = stamps.end();
  const std::size_t most =
      stamps.size() <= kFewestReads
          ? 0
          : std::clamp<std::size_t>(stamps.size() / kRowsToAStray, 1, kFewestReads - 1);
  while (end - begin > 1) {
    const Stamp cut = after_longest_pause(begin, end);
    const Duration pause = *cut - *(cut - 1);
    const bool early = cut - begin < end - cut;  // Whether the strays, if any, come first.
    const Stamp first = early ? cut : begin;
    const Stamp last = early ? end : cut;
    const auto left_out = stamps.size() - static_cast<std::size_t>(last - first);
    if (left_out > most || pause < std::max(kMinPause, *(last - 1) - *first)) break;
    begin = first;
    end = last;
  }
  return {*begin, *(end - 1)};
}

}  // namespace tagfield
