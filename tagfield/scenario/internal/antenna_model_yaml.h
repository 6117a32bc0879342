// SPDX-License-Identifier: Apache-2.0
/// @file
/// The model that an antenna of a scenario is simulated with: the paper's or a physical one, each
/// with keys of its own.
#pragma once

#include <optional>
#include <string>

#include "tagfield/scenario/internal/radio_yaml.h"

namespace tagfield {

/// From the antenna's `model`, or the scenario's. A physical key with the paper's model is an
/// error; one of the paper's keys with a physical model has no effect and causes a warning.
AntennaModel antenna_model_of(YamlMap& antenna, const RadioDefaults& defaults,
                              Diagnostics& diagnostics);

/// An error about the first key of the scenario or of its tags that only physical antennas use;
/// none if there is no such key.
std::optional<Error> key_without_physical_antenna(YamlMap& scenario);

}  // namespace tagfield
