// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's signal model for batches of links.
#pragma once

#include <cstdint>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {

/// Links that are computed together: arrays of equal length.
struct PaperLinks {
  std::span<const double> distance_m;         ///< As in LinkGeometry.
  std::span<const std::uint64_t> first_word;  ///< The first word of each link's noise stream.
  std::span<const std::uint64_t> second_word;
  std::span<const double> optional_rad;  ///< n_optional of each link; empty for none.
};

/// Phases and RSSIs of the links' replies, as given by paper_signal() for each, whatever else is in
/// the batch and whatever the instruction set; written to arrays of the same length.
void paper_signals(const PaperModel& model, const PaperLinks& links, std::span<double> phase_rad,
                   std::span<double> rssi_dbm, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
