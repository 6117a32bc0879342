// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario's world as localization may know it: what becomes of a tag's reply on its way.
#pragma once

#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Traces replies through the scenario's world by the antennas' own models, tags being of their
/// kind and lying as the scenario says (of IDs that it does not have: of the usual kind, upright).
/// Diffuse waves are left out, as nobody knows them. Null where no antenna's waves meet the world.
TraceReplies traced_replies(const Scenario& scenario);

}  // namespace tagfield
