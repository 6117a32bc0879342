// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario's robot as a Gazebo model.
#pragma once

#include "adapters/gazebo_world/internal/bodies.h"

namespace tagfield::gazebo_world_internal {

/// Adds a copy of the model in `model_file` as `robot`, with the parameters of its drive and with
/// the antennas and tags mounted on it. Throws Error if the file can't be read or does not contain
/// a robot model.
void add_robot(Builder& builder, const RobotSpec& robot, const std::string& model_file,
               XMLElement* world);

}  // namespace tagfield::gazebo_world_internal
