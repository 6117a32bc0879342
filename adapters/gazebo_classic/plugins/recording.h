// SPDX-License-Identifier: Apache-2.0
/// @file
/// Recordings of a Gazebo world as ROS 2 MCAP files.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>

#include "adapters/ros2/message_sink.h"

namespace tagfield {

/// The sink of the recordings that the world's recording plugins request in its SDF, whichever
/// plugin is loaded first; null if there are none. Thread-safe. The files are finished when the
/// last reference is released. Write failures are reported as Gazebo errors.
std::shared_ptr<ros2::MessageSink> shared_recording(const gazebo::physics::WorldPtr& world);

}  // namespace tagfield
