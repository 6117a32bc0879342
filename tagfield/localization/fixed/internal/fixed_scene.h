// SPDX-License-Identifier: Apache-2.0
/// @file
/// Antennas at rest and the tags that they read: what strengths and phases of all of them tell.
#pragma once

#include <string>
#include <vector>

#include "tagfield/localization/fixed/channel_offsets.h"
#include "tagfield/localization/fixed/fixed.h"
#include "tagfield/localization/fixed/place_posterior.h"
#include "tagfield/localization/fixed/strength_law.h"

namespace tagfield {

/// A tag and all that is known of it.
struct FixedTag {
  const std::string* name = nullptr;
  const SamplesOfTag* samples = nullptr;
  std::vector<FixedReads> reads;
  TagOnGrid grid;
  double cell_m = 0.0;
  double spread_m = 0.0;  ///< Of the area by itself.
  std::string why_not;
};

struct FixedScene {
  std::vector<std::string> antennas;
  std::vector<FixedTag> tags;
  LearnedLaw law;
  ChannelTurns offsets;
  PhaseField field;
  double trust = 1.0;         ///< Exponent of the phases' likelihoods.
  std::string swapped;        ///< The two antennas that must have been exchanged, or "".
  bool out_of_order = false;  ///< Phases show other carriers than were told; they are not used.
};

/// Learns the law of strengths, the offsets of channels and the phases' field from all tags.
FixedScene fixed_scene(const LocalizationProblem& problem, int threads,
                       const FixedOptions& options);

}  // namespace tagfield
