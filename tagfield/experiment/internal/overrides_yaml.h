// SPDX-License-Identifier: Apache-2.0
/// @file
/// Settings of a scenario in a suite.
#pragma once

#include <string>
#include <vector>

#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// A value as YAML text on one line.
std::string yaml_line_of(const YAML::Node& node);

/// The keys of a mapping, each with `prefix` before it, and their values. Throws Error "FILE:LINE:
/// …" on an empty value.
std::vector<Override> overrides_in(const YamlValue& value, const std::string& prefix);

}  // namespace tagfield
