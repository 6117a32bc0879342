// SPDX-License-Identifier: Apache-2.0
/// @file
/// What can be asked of an antenna, whether it is the paper's or a physical one.
#pragma once

#include <optional>

#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

/// Whether its waves meet what stands in the world.
bool meets_world(const AntennaParameters& antenna);

/// How far it reads [m], as for a picture: the paper's range; of a physical one, which has none of
/// its own, as far as free space and the usual tag allow.
double nominal_range_m(const AntennaParameters& antenna);

/// The carrier, of several the first [Hz].
double nominal_frequency_hz(const AntennaParameters& antenna);

/// What the model states of the phase [rad]: the paper's does, physical ones draw and measure.
struct StatedPhase {
  double offset_rad = 0.0;
  double noise_rad = 0.0;  ///< Standard deviation.
};
std::optional<StatedPhase> stated_phase(const AntennaParameters& antenna);

/// At the reader's port; the paper's model knows no power.
std::optional<double> transmit_power_dbm(const AntennaParameters& antenna);

/// How waves are polarized to which replies owe their phases; none where that does nothing to them
/// (the paper's model, without that effect) or several antennas have a part in it.
std::optional<PolarizationKind> polarization_of(const AntennaParameters& antenna);

}  // namespace tagfield
