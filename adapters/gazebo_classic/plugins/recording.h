// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recordings of a Gazebo world into MCAP files of ROS 2.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>

#include "adapters/ros2/message_sink.h"

namespace tagfield {

/// Where messages go that the world's recording plugins ask for in its SDF, whichever plugin is
/// loaded first; null where none does. May be used from several threads. The files are finished
/// once nobody holds it any more. What can't be written is an error of Gazebo's.
std::shared_ptr<ros2::MessageSink> shared_recording(const gazebo::physics::WorldPtr& world);

}  // namespace tagfield
