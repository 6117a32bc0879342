// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/internal/slot_draw.h"

#include <cmath>

namespace tagfield {
namespace {

/// Number of failures before the next success, given the logarithm of the probability of failure.
double failures(RandomStream& stream, double log_failure) {
  return std::floor(std::log(uniform_above_0(stream)) / log_failure);
}

}  // namespace

void draw_repliers(std::int64_t slots_left, RandomStream& stream,
                   std::vector<std::uint32_t>& waiting, std::vector<std::uint32_t>& repliers) {
  repliers.clear();
  if (slots_left == 1) repliers.swap(waiting);
  if (waiting.empty()) return;
  const double log_failure = std::log1p(-1.0 / static_cast<double>(slots_left));
  const auto count = static_cast<double>(waiting.size());
  for (double place = failures(stream, log_failure); place < count;
       place += 1.0 + failures(stream, log_failure)) {
    repliers.push_back(static_cast<std::uint32_t>(place));
  }
  // From the back, so that the element moved into a gap is never one that is still to be moved.
  for (auto place = repliers.rbegin(); place != repliers.rend(); ++place) {
    const std::uint32_t tag = waiting[*place];
    waiting[*place] = waiting.back();
    waiting.pop_back();
    *place = tag;
  }
}

}  // namespace tagfield
