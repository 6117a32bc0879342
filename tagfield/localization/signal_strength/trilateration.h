// SPDX-License-Identifier: Apache-2.0
/// @file
/// Trilateration by RSSI: RSSI decreases linearly with the logarithm of the distance; slope and
/// level are estimated, too. docs/methods.md has the equations and the figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/signal_strength/lobe.h"

namespace tagfield {

struct TrilaterationOptions : Lobe {
  /// Decrease of RSSI per decade of distance [dB]: 40 in free space, both ways.
  double slope_db = 40.0;
  double slope_sigma_db = 8.0;  ///< Prior standard deviation of the slope; 0: known.
  /// Standard deviation between tags of one kind [dB]; with reference tags, the level of the others
  /// is theirs up to this.
  double tag_sigma_db = 2.0;
  double bin_m = 0.2;         ///< Reads over this distance of travel are averaged; over 0.
  double max_range_m = 12.0;  ///< Maximum distance at which a tag is read; over 0.
  /// Replaces the problem's limits, which are for phase.
  double max_expected_error_m = 3.0;
  double max_misfit_db = 10.0;  ///< With a larger rms, RSSI follows no path-loss law.
};

/// Method "trilateration": first one slope for all tags, then each tag independently. Throws Error
/// on options out of range.
Method trilateration_method(const TrilaterationOptions& options = {});

}  // namespace tagfield
