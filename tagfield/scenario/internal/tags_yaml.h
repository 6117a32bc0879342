// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tags of a scenario, from YAML and from the tables that it names.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Requires that IDs written as EPC URIs are valid. Throws Error "FILE:LINE: …".
void require_epcs(const std::vector<TagSpec>& tags);

/// The keys `tags`, `tag_table` and `tag_recording` of a scenario. Throws Error "FILE:LINE: …",
/// also for IDs that are written as EPC URIs and are none.
std::vector<TagSpec> tags_of(YamlMap& map, const RadioDefaults& radio, Diagnostics& diagnostics);

}  // namespace tagfield
