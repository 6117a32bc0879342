// SPDX-License-Identifier: Apache-2.0
/// @file
/// Robots and obstacles as waves meet them.
#pragma once

#include <string>
#include <vector>

#include "tagfield/channel/moving_body.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// A robot's body on its base frame B.
MovingBody body_of(const std::string& robot, const RobotBody& body, const RigidTransform& X_WB);

/// Those obstacles that have a body and are there at `stamp`, where they are then.
std::vector<MovingBody> bodies_of(const std::vector<ObstacleSpec>& obstacles, Time stamp);

}  // namespace tagfield
