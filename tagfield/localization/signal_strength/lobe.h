// SPDX-License-Identifier: Apache-2.0
/// @file
/// Directional gain of an antenna, as far as a data sheet gives it: a lobe around the boresight.
#pragma once

#include <Eigen/Core>

#include "tagfield/base/setting.h"

namespace tagfield {

/// Lobe of antennas whose boresight is the x axis of their poses: cosⁿ of the angle off boresight,
/// with n from the half-power width, but at least `-front_to_back_db`. Base of options.
struct Lobe {
  double beam_width_deg = 0.0;  ///< 0: orientation unknown or irrelevant.
  double front_to_back_db = 25.0;
};

/// The lobe of an antenna that looks in one direction, for many gains.
struct AimedLobe {
  Eigen::Vector3d boresight_W;  ///< Unit vector.
  double exponent = 0.0;        ///< n of cosⁿ; 0 if the lobe is unknown.
  double least_db = 0.0;        ///< Gain [dB] one way behind the antenna.
};

AimedLobe aimed(const Lobe& lobe, const Eigen::Vector3d& boresight_W);

/// Round-trip gain relative to boresight [dB] in the direction `way_W` from the antenna; 0 if the
/// lobe is unknown.
double lobe_db(const AimedLobe& lobe, const Eigen::Vector3d& way_W);
double lobe_db(const Lobe& lobe, const Eigen::Vector3d& boresight_W, const Eigen::Vector3d& way_W);

/// Keys of options with a lobe.
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
