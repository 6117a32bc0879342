// SPDX-License-Identifier: Apache-2.0
/// @file
/// Names of the materials of visuals.
#pragma once

#include <tinyxml2.h>

#include <set>
#include <string>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Adds the materials that a <visual> names: its script's material, its colour "rgba(r, g, b, a)",
/// or else the materials of its mesh. Warns of a mesh that can't be found or read.
void add_materials(Context& context, const tinyxml2::XMLElement& visual,
                   std::set<std::string>& materials);

}  // namespace tagfield::sdf_internal
