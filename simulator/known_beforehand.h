/// @file
/// What localization may know of a scenario before any read comes.
#pragma once

#include "simulator/scenario.h"
#include "tagfield/localization/problem.h"

namespace tagfield {

/// Heights, reference tags, offsets and the pose error's model, as far as the scenario's
/// `localization` says that they are known.
KnownBeforehand known_beforehand(const Scenario& scenario);

}  // namespace tagfield
