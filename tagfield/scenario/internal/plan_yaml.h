// SPDX-License-Identifier: Apache-2.0
/// @file
/// The section `plan` of a scenario.
#pragma once

#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/plan_spec.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Reads the whole section. `duration_s` is the tags' dwell time if the section gives none.
PlanSpec plan_of(YamlMap map, const RadioDefaults& radio, double duration_s,
                 Diagnostics& diagnostics);

}  // namespace tagfield
