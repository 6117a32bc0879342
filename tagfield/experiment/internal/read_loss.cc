// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/read_loss.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/random.h"

namespace tagfield {
namespace {

bool is_lost_alone(const TagRead& read, double share, std::uint64_t seed) {
  const auto stamp = static_cast<std::uint64_t>(read.stamp.time_since_epoch().count());
  RandomStream stream(seed, Purpose::kReadLoss, stream_key(read.antenna), stream_key(read.tag),
                      stamp);
  return uniform_above_0(stream) <= share;
}

/// Begins of bursts [s], ascending, including all bursts that overlap first_s … last_s.
std::vector<double> begins_of_bursts(const ReadLoss& loss, double first_s, double last_s,
                                     std::uint64_t seed) {
  std::vector<double> begins;
  RandomStream stream(seed, Purpose::kReadLoss);
  double begin_s = first_s - loss.burst_s;
  while (true) {
    begin_s -= loss.every_s * std::log(uniform_above_0(stream));
    if (begin_s > last_s) return begins;
    begins.push_back(begin_s);
  }
}

std::vector<double> begins_of_bursts(const std::vector<TagRead>& reads, const ReadLoss& loss,
                                     std::uint64_t seed) {
  if (reads.empty() || !(loss.burst_s > 0.0 && loss.every_s > 0.0)) return {};
  const auto [first, last] =
      std::minmax_element(reads.begin(), reads.end(),
                          [](const TagRead& a, const TagRead& b) { return a.stamp < b.stamp; });
  return begins_of_bursts(loss, to_seconds(first->stamp), to_seconds(last->stamp), seed);
}

/// Only the most recent burst can still be active, as all are equally long.
bool is_in_burst(double stamp_s, const std::vector<double>& begins, double burst_s) {
  const auto next = std::upper_bound(begins.begin(), begins.end(), stamp_s);
  return next != begins.begin() && stamp_s < *std::prev(next) + burst_s;
}

}  // namespace

std::vector<bool> lost_reads(const std::vector<TagRead>& reads, const ReadLoss& loss,
                             std::uint64_t seed) {
  const std::vector<double> begins = begins_of_bursts(reads, loss, seed);
  std::vector<bool> lost;
  lost.reserve(reads.size());
  for (const TagRead& read : reads) {
    lost.push_back(is_in_burst(to_seconds(read.stamp), begins, loss.burst_s) ||
                   is_lost_alone(read, loss.share, seed));
  }
  return lost;
}

std::vector<TagRead> without_lost(const std::vector<TagRead>& reads, const ReadLoss& loss,
                                  std::uint64_t seed) {
  const std::vector<bool> lost = lost_reads(reads, loss, seed);
  std::vector<TagRead> kept;
  for (std::size_t i = 0; i < reads.size(); ++i) {
    if (!lost[i]) kept.push_back(reads[i]);
  }
  return kept;
}

}  // namespace tagfield
