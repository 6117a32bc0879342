// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads that are lost in transit from a reader, individually and in bursts.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Whether the i-th read is lost. Individual losses depend only on the seed and on the read's
/// antenna, tag and timestamp. Bursts begin as a Poisson process, simultaneously for all antennas,
/// and may overlap, so that they cover the share 1 − e^(−burst_s / every_s) of the time.
std::vector<bool> lost_reads(const std::vector<TagRead>& reads, const ReadLoss& loss,
                             std::uint64_t seed);

/// The reads that are not lost.
std::vector<TagRead> without_lost(const std::vector<TagRead>& reads, const ReadLoss& loss,
                                  std::uint64_t seed);

}  // namespace tagfield
