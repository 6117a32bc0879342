// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which kinds of tags a scenario has.
#pragma once

#include <memory>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Each kind of the scenario's tags once, in order of first occurrence; default_tag_model() for
/// tags without one.
std::vector<std::shared_ptr<const TagModel>> kinds_of_tags(const Scenario& scenario);

}  // namespace tagfield
