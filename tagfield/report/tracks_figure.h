// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tracks of tags as figures.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/stream/truth.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield {

/// From above: the likeliest track of each tag, its true path if known, the antennas, and the line
/// at which the tags' order is reported.
Figure tracks_figure(const std::vector<TagTrack>& tracks, const std::vector<AntennaPose>& antennas,
                     const Truth& truth, const std::optional<PassingLine>& line = {});

/// The horizontal speed of each tag's likeliest track over time; for a few tags with individual
/// colours and legend entries.
Figure speeds_figure(const std::vector<TagTrack>& tracks);

}  // namespace tagfield
