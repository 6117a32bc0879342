// SPDX-License-Identifier: Apache-2.0
/// @file
/// An explained link as JSON for machines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// The complete explanation; powers of signals that never arrive are null.
nlohmann::ordered_json to_json(const LinkExplanation& link);

}  // namespace tagfield
