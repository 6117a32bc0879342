// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks from above, as a drawing of its own.
#pragma once

#include <string>
#include <vector>

#include "tagfield/stream/truth.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// An SVG file: the likeliest track of each tag, its true way where that is known, the antennas.
std::string tracks_figure(const std::vector<TagTrack>& tracks,
                          const std::vector<AntennaPose>& antennas, const Truth& truth);

}  // namespace tagfield
