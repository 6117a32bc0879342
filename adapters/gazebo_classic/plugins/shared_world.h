/// @file
/// The RFID world that all plugins of a Gazebo world share, with ROS and the window as listeners.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace tagfield {

/// Made for the first plugin that asks, gone with the last that holds it. `report_cost` makes it
/// print its FieldCost when it goes.
std::shared_ptr<RfidWorld> shared_rfid_world(const gazebo::physics::WorldPtr& world);

}  // namespace tagfield
