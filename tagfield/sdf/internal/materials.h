/// @file
/// Names of the materials that visuals wear.
#pragma once

#include <sdf/Visual.hh>
#include <set>
#include <string>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Adds what `visual` wears: the name of its material script, or "rgba(r, g, b, a)" of its diffuse
/// colour, or the names of its mesh's own materials. A mesh that can't be read is a warning.
void add_materials(Context& context, const sdf::Visual& visual, std::set<std::string>& materials);

}  // namespace tagfield::sdf_internal
