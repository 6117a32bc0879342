// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scenarios whose moving tags are tracked.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "tagfield/experiment/in_parts.h"
#include "tagfield/report/track_judgement.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// One seed, simulated and tracked.
struct TrackingRun {
  std::uint64_t seed = 0;
  std::vector<TagRead> reads;  ///< By track_in_parts() each tag's first and last alone.
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

/// Of tags tracked in parts so many are kept with their tracks, and of a track so many errors.
inline constexpr std::size_t kTracksKept = 1000;
inline constexpr std::size_t kErrorsKept = 25;

/// Tracks each part's tags as track() tracks them where there are no others, and judges them.
/// `on_tracks` gets those of each part; `run` keeps the first kTracksKept, and outcomes of all,
/// with every second, third, … error of a track. `on_progress` may be null.
void track_in_parts(const TrackingSpec& spec, const KnownBeforehand& known, int threads,
                    const ReadParts& parts,
                    const std::function<void(const std::vector<TagTrack>&)>& on_tracks,
                    const std::function<void(double)>& on_progress, TrackingRun& run,
                    Diagnostics& diagnostics);

/// Simulates and tracks `count` ≥ 1 seeds from `first` on, in parallel. Reads, poses and truth are
/// kept of the first only.
std::vector<TrackingRun> track_seeds(const Scenario& scenario, std::uint64_t first,
                                     std::size_t count, const RunControl& control,
                                     Diagnostics& diagnostics);

}  // namespace tagfield
