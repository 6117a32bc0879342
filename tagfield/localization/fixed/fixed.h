// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization of tags read by a few stationary antennas: RSSI by a path-loss law learned from all
/// tags jointly and, where the offsets of the channels are known, ranges from the phases of many
/// channels. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/fixed/strength_law.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct FixedOptions : StrengthPrior {
  double max_range_m = 12.0;  ///< Maximum distance at which a tag is read; over 0.
  /// Replaces the problem's limits, which are meant for phase.
  double max_expected_error_m = 3.0;
};

/// Method "fixed": first one law for all tags, then each tag in turn. Throws Error on options out
/// of range.
Method fixed_method(const FixedOptions& options = {});

}  // namespace tagfield
