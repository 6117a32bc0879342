// SPDX-License-Identifier: Apache-2.0
/// @file
/// The path-loss law of a problem: its slope, levels of reference tags, and how much gains depend
/// on direction, learned from the RSSI of up to twelve tags.
#pragma once

#include "tagfield/localization/signal_strength/rssi_fit.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield {

/// With reference tags, slope and levels come from a straight line through theirs. Otherwise the
/// slope is that which suits all tags best, each at its best position. Gains depend on direction by
/// as much as a law without that leaves in slow errors. Without reads it is the options' law.
PathLossLaw path_loss_law(const LocalizationProblem& problem, const TrilaterationOptions& options);

}  // namespace tagfield
