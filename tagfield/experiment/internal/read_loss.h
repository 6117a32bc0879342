// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads that get lost on the way from a reader, one by one and in bursts.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Whether the i-th read is lost. Whether a read is lost by itself depends on the seed, its
/// antenna, tag and stamp alone; bursts begin as a Poisson process, at once for all antennas, and
/// may overlap, so that they take the share 1 − e^(−burst_s / every_s) of the time.
std::vector<bool> lost_reads(const std::vector<TagRead>& reads, const ReadLoss& loss,
                             std::uint64_t seed);

/// The reads that are left.
std::vector<TagRead> without_lost(const std::vector<TagRead>& reads, const ReadLoss& loss,
                                  std::uint64_t seed);

}  // namespace tagfield
