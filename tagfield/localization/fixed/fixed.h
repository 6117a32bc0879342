// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tags read by a few antennas at rest: strengths by a law that all tags tell together, and, where
/// the offsets of the channels are known, distances by the phases of many channels.
/// docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/fixed/strength_law.h"
#include "tagfield/localization/method.h"

namespace tagfield {

struct FixedOptions : StrengthPrior {
  double max_range_m = 12.0;  ///< No tag is read from further away; over 0.
  /// In place of the problem's limits, which are for phase.
  double max_expected_error_m = 3.0;
};

/// "fixed": one law for all tags, then all tags, one by one. Throws Error on options out of their
/// range.
Method fixed_method(const FixedOptions& options = {});

}  // namespace tagfield
