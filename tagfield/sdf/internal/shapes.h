/// @file
/// SDF geometry to shapes.
#pragma once

#include <optional>
#include <sdf/Geometry.hh>
#include <string>

#include "tagfield/sdf/internal/context.h"
#include "tagfield/world/scene.h"

namespace tagfield::sdf_internal {

/// The shape of the collision `name`, whose element is `collision`. None, with a warning, for a
/// kind of shape that is not supported. Throws Error for a size that is missing, not positive or
/// not finite, and for a mesh that can't be found or read.
std::optional<Shape> read_shape(Context& context, const sdf::Geometry& geometry,
                                const sdf::ElementPtr& collision, const std::string& name);

/// The path of a mesh's file. Throws Error if there is none.
std::string mesh_path(const Context& context, const sdf::Mesh& mesh);

}  // namespace tagfield::sdf_internal
