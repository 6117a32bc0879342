// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracking of the moving tags of a scenario.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
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
  std::vector<TagRead> reads;  ///< With track_in_parts() only each tag's first and last one.
  std::vector<AntennaPose> believed_poses;
  Truth truth;
  std::vector<TagTrack> tracks;
  std::vector<PassingOrder> orders;
  std::optional<PassingLine> line;  ///< Of `orders`, if one was given.
  std::vector<TrackOutcome> outcomes;
  std::vector<OrderOutcome> order_outcomes;
};

/// Computes tracks from the reads and judges them by `truth`, which may be empty. Of `control`,
/// `threads`, `on_stage` and `stop` are used; throws LocatingStopped (stoppable.h) once that is
/// set.
void track(const TrackingSpec& spec, const KnownBeforehand& known, const RunControl& control,
           TrackingRun& run, Diagnostics& diagnostics);

/// Maximum number of tracks kept of tags tracked in parts, and of errors kept per track.
inline constexpr std::size_t kTracksKept = 1000;
inline constexpr std::size_t kErrorsKept = 25;

/// Tracks each part's tags as track() would without any others, and judges them. `on_tracks`
/// receives the tracks of each part; `run` keeps the first kTracksKept of them, and the outcomes of
/// all, with the errors thinned to at most kErrorsKept per track. `on_progress` may be null.
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
