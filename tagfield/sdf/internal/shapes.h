// SPDX-License-Identifier: Apache-2.0
/// @file
/// SDF geometry to shapes.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// The shape of `collision`, a <collision>, called `name` in messages. Capsules, ellipsoids, cones,
/// polylines and heightmaps become meshes. A size that is left out is the one that Gazebo takes,
/// with a warning. None, with a warning, for a shape without volume and one of another kind; none
/// where its file is missing, which the context remembers. Throws Error for a size that is no
/// number.
std::optional<Shape> read_shape(Context& context, const tinyxml2::XMLElement& collision,
                                const std::string& name);

}  // namespace tagfield::sdf_internal
