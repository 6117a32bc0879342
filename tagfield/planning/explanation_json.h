// SPDX-License-Identifier: Apache-2.0
/// @file
/// An explained link as JSON for machines.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "tagfield/planning/link_explanation.h"

namespace tagfield {

/// All of it; powers of what never arrives are null.
nlohmann::ordered_json to_json(const LinkExplanation& link);

}  // namespace tagfield
