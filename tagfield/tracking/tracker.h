// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: reads joined with antenna places in, a track for each tag out. Knows
/// nothing of where the tags really are.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/problem.h"
#include "tagfield/tracking/track.h"
#include "tagfield/tracking/tracking_options.h"

namespace tagfield {

/// A track for each tag in the problem's samples, in rising order of their IDs, reference tags
/// left out. Deterministic, whatever the number of threads. Throws Error on options out of range.
std::vector<TagTrack> track_tags(const LocalizationProblem& problem, const TrackingOptions& options,
                                 int threads, Diagnostics& diagnostics);

}  // namespace tagfield
