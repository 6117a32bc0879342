// SPDX-License-Identifier: Apache-2.0
/// @file
/// The names of what visuals wear.
#pragma once

#include <tinyxml2.h>

#include <set>
#include <string>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Adds what a <visual> names: its script's material, its colour "rgba(r, g, b, a)", or else the
/// materials of the mesh that it shows. A mesh that can't be found or read is a warning.
void add_materials(Context& context, const tinyxml2::XMLElement& visual,
                   std::set<std::string>& materials);

}  // namespace tagfield::sdf_internal
