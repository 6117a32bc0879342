// SPDX-License-Identifier: Apache-2.0
/// @file
/// The RFID world shared by all plugins of a Gazebo world, with ROS, the window and recordings as
/// listeners.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace tagfield {

/// Created for the first plugin that requests it, destroyed with the last that holds it. If the
/// environment variable TAGFIELD_REPORT_COST is set, its FieldCost is then printed on standard
/// output as a line of JSON: means in milliseconds per antenna update.
std::shared_ptr<RfidWorld> shared_rfid_world(const gazebo::physics::WorldPtr& world);

}  // namespace tagfield
