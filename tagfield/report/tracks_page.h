// SPDX-License-Identifier: Apache-2.0
/// @file
/// The page of tracked tags.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/report/track_judgement.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// The content of the page; no pointer is null. The summary is of all seeds, everything else of the
/// first.
struct TracksShown {
  std::size_t tag_count = 0;  ///< Of the first seed; larger than `tracks` if those are only a part.
  std::size_t read_count = 0;  ///< Same, but for reads.
  const TrackSummary* summary = nullptr;
  const std::vector<TagRead>* reads = nullptr;  ///< At least each tag's first and last one.
  const std::vector<AntennaPose>* antennas = nullptr;
  const Truth* truth = nullptr;
  const std::vector<TagTrack>* tracks = nullptr;
  const std::vector<PassingOrder>* orders = nullptr;
  std::optional<PassingLine> line{};  ///< The one of `orders`, if any.
};

/// The results in sentences of plain text: how many tags were tracked, with what errors, and in
/// which order they passed.
std::string tracks_sentence(const TrackNumbers& numbers, const std::vector<PassingOrder>& orders);

std::vector<Figure> tracks_figures(const TracksShown& shown);

/// The page, self-contained in one file.
std::string tracks_page(const TracksShown& shown, const std::vector<Figure>& figures);

}  // namespace tagfield
