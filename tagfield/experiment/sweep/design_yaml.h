// SPDX-License-Identifier: Apache-2.0
/// @file
/// The section `sweep` of a suite.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/sweep/design.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Reads the section. `methods`: the names in the suite, of which `adaptive` chooses one. `seeds`:
/// the suite's number of seeds per point. Throws Error "FILE:LINE: …".
SweepDesign sweep_design_of(const YamlValue& value, const std::vector<std::string>& methods,
                            std::uint64_t seeds);

/// "mean_m", "median_m", "p95_m", "max_m", "located", "wrong", "false_claims".
std::string to_string(SweepTarget target);

}  // namespace tagfield
