// SPDX-License-Identifier: Apache-2.0
/// @file
/// What an antenna of a scenario is simulated by: the paper's model or a physical one, each with
/// keys of its own.
#pragma once

#include <optional>
#include <string>

#include "tagfield/scenario/internal/radio_yaml.h"

namespace tagfield {

/// From the antenna's `model`, or the scenario's. A physical key beside the paper's model is an
/// error; one of the paper's beside a physical model, which has no effect, is warned of.
AntennaModel antenna_model_of(YamlMap& antenna, const RadioDefaults& defaults,
                              Diagnostics& diagnostics);

/// A complaint about the first of the scenario's keys, or of its tags', that are of use to physical
/// antennas alone; none where there is no such key.
std::optional<Error> key_without_physical_antenna(YamlMap& scenario);

}  // namespace tagfield
