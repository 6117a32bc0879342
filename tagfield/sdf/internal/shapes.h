// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of SDF geometry to shapes.
#pragma once

#include <tinyxml2.h>

#include <optional>
#include <string>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// The shape of `collision`, a <collision>, called `name` in messages. Capsules, ellipsoids, cones,
/// polylines and heightmaps become meshes. A missing size gets Gazebo's default, with a warning.
/// Nullopt, with a warning, for a shape without volume or of unknown type; nullopt if its file is
/// missing, which the context records. Throws Error for a size that is not a number.
std::optional<Shape> read_shape(Context& context, const tinyxml2::XMLElement& collision,
                                const std::string& name);

}  // namespace tagfield::sdf_internal
