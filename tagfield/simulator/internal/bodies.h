// SPDX-License-Identifier: Apache-2.0
/// @file
/// Robots and obstacles as seen by waves.
#pragma once

#include <string>
#include <vector>

#include "tagfield/channel/moving_body.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// A robot's body, in its base frame B.
MovingBody body_of(const std::string& robot, const RobotBody& body, const RigidTransform& X_WB);

/// The obstacles that have a body and are present at `stamp`, at their positions then.
std::vector<MovingBody> bodies_of(const std::vector<ObstacleSpec>& obstacles, Time stamp);

}  // namespace tagfield
