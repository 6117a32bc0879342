// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tracks that explain a pass, and how much acceleration they take.
#pragma once

#include <vector>

#include "tagfield/tracking/internal/pass.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// Whether the phases are explained by the acceleration noise of the options.
enum class Demand {
  kNone,
  kMore,     ///< Only by more.
  kTooMuch,  ///< Not even by the most that is tried.
  kUnclear,  ///< Not by the stated one, and with more, without a lane, residuals are not noise.
};

struct TracksFound {
  std::vector<Track> tracks;  ///< That the phases cannot distinguish, best first.
  Demand demand = Demand::kNone;
  double demanded_noise = 0.0;  ///< The likeliest acceleration noise [m/s²/√Hz].
};

/// Smooths the straight motions of search_lines() with the acceleration noise of the options and
/// with more, along the lane if there is one, and takes the largest noise that the reads' evidence
/// does not exclude. Where it excludes the options' own, the covariances are multiplied by four:
/// acceleration and slow errors of the phases, as by reflections, cannot be told apart, and the
/// latter shift positions, too.
TracksFound find_tracks(const Pass& pass, const TrackingOptions& options);

/// Lateral deviation of a track from the lane, halfway [sigmas]; 0 without a lane.
double beside_lane(const TrackingOptions& options, const Track& track);

}  // namespace tagfield
