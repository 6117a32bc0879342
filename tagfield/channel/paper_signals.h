// SPDX-License-Identifier: Apache-2.0
/// @file
/// The paper's signal model for many links at once.
#pragma once

#include <cstdint>
#include <span>

#include "tagfield/base/lanes.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {

/// Links that are computed together: arrays of one length.
struct PaperLinks {
  std::span<const double> distance_m;         ///< As in LinkGeometry.
  std::span<const std::uint64_t> first_word;  ///< Of each link's stream of noise.
  std::span<const std::uint64_t> second_word;
  std::span<const double> optional_rad;  ///< n_optional of each; empty for none.
};

/// The phases and RSSIs of the links' replies, as paper_signal() gives each, whatever else is in
/// the batch and whatever the instruction set; into arrays of the same length.
void paper_signals(const PaperModel& model, const PaperLinks& links, std::span<double> phase_rad,
                   std::span<double> rssi_dbm, InstructionSet set = instruction_sets().back());

}  // namespace tagfield
