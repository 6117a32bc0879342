// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scenarios whose moving tags are tracked.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/report/track_judgement.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// One seed, simulated and tracked.
struct TrackingRun {
  std::uint64_t seed = 0;
  std::vector<TagRead> reads;
  std::vector<AntennaPose> believed_poses;
  Truth truth;
  std::vector<TagTrack> tracks;
  std::vector<PassingOrder> orders;
  std::vector<TrackOutcome> outcomes;
  std::vector<OrderOutcome> order_outcomes;
};

/// Tracks what was read and judges it by `truth`, which may be empty.
void track(const TrackingSpec& spec, const KnownBeforehand& known, int threads, TrackingRun& run,
           Diagnostics& diagnostics);

/// Simulates and tracks `count` ≥ 1 seeds from `first` on, in parallel. Reads, poses and truth are
/// kept of the first only.
std::vector<TrackingRun> track_seeds(const Scenario& scenario, std::uint64_t first,
                                     std::size_t count, const RunControl& control,
                                     Diagnostics& diagnostics);

}  // namespace tagfield
