// SPDX-License-Identifier: Apache-2.0
/// @file
/// The path-loss laws of a problem: their slope, levels of reference tags, and how much gains
/// depend on direction, learned from the RSSI of up to twelve tags.
#pragma once

#include "tagfield/localization/signal_strength/rssi_fit.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield {

struct PathLossLaws {
  PathLossLaw isotropic;    ///< The same gain in all directions.
  PathLossLaw directional;  ///< Gains vary by as much as the isotropic law leaves in slow errors.
};

/// With reference tags, slope and levels come from a straight line through theirs. Otherwise the
/// slope is that which suits all tags best, each at its best position. Without reads they are the
/// options' law.
PathLossLaws path_loss_laws(const LocalizationProblem& problem,
                            const TrilaterationOptions& options);

}  // namespace tagfield
