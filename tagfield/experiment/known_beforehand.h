// SPDX-License-Identifier: Apache-2.0
/// @file
/// What localization may know of a scenario before any read comes.
#pragma once

#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Heights, reference tags, offsets and the pose error's model, as far as the scenario's
/// `localization` says that they are known.
KnownBeforehand known_beforehand(const Scenario& scenario);

}  // namespace tagfield
