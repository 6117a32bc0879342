// SPDX-License-Identifier: Apache-2.0
/// @file
/// The RFID world that all plugins of a Gazebo world share, with ROS, the window and recordings as
/// listeners.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace tagfield {

/// Made for the first plugin that asks, gone with the last that holds it. Then, if the environment
/// has TAGFIELD_REPORT_COST, it prints its FieldCost as a line of JSON on standard output: means in
/// milliseconds an antenna update.
std::shared_ptr<RfidWorld> shared_rfid_world(const gazebo::physics::WorldPtr& world);

}  // namespace tagfield
