// SPDX-License-Identifier: Apache-2.0
/// @file
/// Gain of an antenna over direction, as far as a data sheet tells it: a lobe about the boresight.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/setting.h"

namespace tagfield {

/// Of antennas whose poses say where they look, along their x axes: cosⁿ of the angle off the
/// boresight, n by the half-power width; never under `-front_to_back_db`. Base of options.
struct Lobe {
  double beam_width_deg = 0.0;  ///< 0: where antennas look is not known, or doesn't matter.
  double front_to_back_db = 25.0;
};

/// There and back, over that along the boresight [dB], towards `way_W` from the antenna; 0 where
/// the lobe is not known.
double lobe_db(const Lobe& lobe, const Eigen::Vector3d& boresight_W, const Eigen::Vector3d& way_W);

/// The keys of options with a lobe.
template <class Options>
std::vector<Setting<Options>> with_lobe(std::vector<Setting<Options>> table) {
  table.push_back(setting<Options>(
      "beam_width_deg", "deg",
      "half-power width of antennas that look along the x axes of their poses; 0: not known",
      &Lobe::beam_width_deg, ValueRange{0.0, false, 179.0}));
  table.push_back(setting<Options>("front_to_back_db", "dB",
                                   "front-to-back ratio of these antennas", &Lobe::front_to_back_db,
                                   kAtLeastZero));
  return table;
}

}  // namespace tagfield
