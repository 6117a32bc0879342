// SPDX-License-Identifier: Apache-2.0
/// @file
/// The page of tracked tags.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/report/track_judgement.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// What the page is made of; none is null. The summary is of all seeds, all else of the first.
struct TracksShown {
  std::size_t tag_count = 0;   ///< Of the first seed; of more than `tracks` where those are a part.
  std::size_t read_count = 0;  ///< Likewise.
  const TrackSummary* summary = nullptr;
  const std::vector<TagRead>* reads = nullptr;  ///< Each tag's first and last among them.
  const std::vector<AntennaPose>* antennas = nullptr;
  const Truth* truth = nullptr;
  const std::vector<TagTrack>* tracks = nullptr;
  const std::vector<PassingOrder>* orders = nullptr;
};

/// What came out, in sentences of plain text: how many tags were tracked, how far off, and in which
/// order they passed.
std::string tracks_sentence(const TrackNumbers& numbers, const std::vector<PassingOrder>& orders);

std::vector<Figure> tracks_figures(const TracksShown& shown);

/// One file that asks for nothing from anywhere.
std::string tracks_page(const TracksShown& shown, const std::vector<Figure>& figures);

}  // namespace tagfield
