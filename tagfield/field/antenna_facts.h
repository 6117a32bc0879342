// SPDX-License-Identifier: Apache-2.0
/// @file
/// Properties of an antenna that are available for both the paper's model and physical ones.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {

struct TagModel;

/// Whether its waves interact with objects in the world.
bool meets_world(const AntennaParameters& antenna);

/// Its range [m]: the paper's range; for a physical model, which has no range parameter,
/// free_space_range_m() of the most readable of these kinds of tags, or of the default tag if there
/// are none, less what antennas of unlike polarization lose.
double nominal_range_m(const AntennaParameters& antenna,
                       const std::vector<std::shared_ptr<const TagModel>>& kinds = {});

/// The same where all paths add up (max_field_factor()): nothing further away is read.
double largest_range_m(const AntennaParameters& antenna,
                       const std::vector<std::shared_ptr<const TagModel>>& kinds = {});

/// The carrier frequency, or the first of several [Hz].
double nominal_frequency_hz(const AntennaParameters& antenna);

/// Phase parameters given by the model [rad]: the paper's model has them; physical ones draw and
/// simulate them.
struct StatedPhase {
  double offset_rad = 0.0;
  double noise_rad = 0.0;  ///< Standard deviation.
};
std::optional<StatedPhase> stated_phase(const AntennaParameters& antenna);

/// At the reader's port; the paper's model has no power.
std::optional<double> transmit_power_dbm(const AntennaParameters& antenna);

/// Polarization of the waves that determine the replies' phases; nullopt if polarization has no
/// effect on them (the paper's model, or the effect is off) or if several antennas are involved.
std::optional<PolarizationKind> polarization_of(const AntennaParameters& antenna);

}  // namespace tagfield
