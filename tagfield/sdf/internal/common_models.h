// SPDX-License-Identifier: Apache-2.0
/// @file
/// Models that nearly every world includes by name and that come with Gazebo, for machines that
/// have no Gazebo.
#pragma once

#include <tinyxml2.h>

#include "tagfield/sdf/internal/context.h"

namespace tagfield::sdf_internal {

/// Whether a <uri> names one of them ("model://sun", Fuel's "Ground Plane" of
/// OpenRobotics) that can't be found.
bool lacks_common_model(const Context& context, const tinyxml2::XMLElement& uri);

/// The model that the <uri> of an <include> names, with a warning that it can't be found: the
/// ground plane is 100 m x 100 m at z = 0 around its origin, in a link and a collision named as
/// Gazebo's; the sun is a light and null.
const tinyxml2::XMLElement* common_model(Context& context, const tinyxml2::XMLElement& uri);

}  // namespace tagfield::sdf_internal
