/// @file
/// Poses of SDF elements.
#pragma once

#include <ignition/math/Pose3.hh>
#include <sdf/SemanticPose.hh>

#include "tagfield/poses/rigid_transform.h"
#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

RigidTransform to_transform(const ignition::math::Pose3d& pose);

/// The pose of a model, link, collision or sensor B (`element`) in the element P around it. One
/// that names no frame is taken as written, so that an error elsewhere in the world can't change
/// it; any other is resolved by sdformat. Throws Error if it is not finite or can't be resolved.
RigidTransform pose_in_parent(const Context& context, const sdf::SemanticPose& pose,
                              const sdf::ElementPtr& element);

}  // namespace tagfield::sdf_internal
