// SPDX-License-Identifier: Apache-2.0
/// @file
/// Distances from signal strength: RSSI falls by a straight line over the logarithm of the
/// distance, whose slope and height are estimated too. docs/methods.md has the equations and the
/// figures.
#pragma once

#include "tagfield/localization/method.h"
#include "tagfield/localization/signal_strength/lobe.h"

namespace tagfield {

struct TrilaterationOptions : Lobe {
  /// RSSI falls by so many decibels for ten times the distance: 40 there and back in free space.
  double slope_db = 40.0;
  double slope_sigma_db = 8.0;  ///< How uncertain that is before the data are seen; 0: it is known.
  /// How tags of one kind differ [dB]; with reference tags the others' height of the line is theirs
  /// but for this.
  double tag_sigma_db = 2.0;
  double bin_m = 0.2;         ///< Reads over so much travel are averaged; over 0.
  double max_range_m = 12.0;  ///< No tag is read from further away; over 0.
  /// In place of the problem's limits, which are for phase.
  double max_expected_error_m = 3.0;
  double max_misfit_db = 10.0;  ///< A worse rms is no law of distance.
};

/// "trilateration": one slope for all, then all tags, one by one. Throws Error on options out of
/// their range.
Method trilateration_method(const TrilaterationOptions& options = {});

}  // namespace tagfield
