// SPDX-License-Identifier: Apache-2.0
/// @file
/// The keys `localization` and `tracking` of a scenario.
#pragma once

#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// `localization: none`, or a mapping; `methods` are the valid ones.
LocalizationSpec localization_of(const YamlValue& value, const std::vector<Method>& methods,
                                 Diagnostics& diagnostics);

TrackingSpec tracking_of(YamlMap map);

}  // namespace tagfield
