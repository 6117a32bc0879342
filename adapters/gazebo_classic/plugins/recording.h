/// @file
/// Recordings of a Gazebo world into MCAP files of ROS 2.
#pragma once

#include <gazebo/physics/PhysicsTypes.hh>
#include <memory>
#include <vector>

#include "adapters/ros2/message_sink.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

using Recordings = std::vector<std::shared_ptr<ros2::MessageSink>>;

/// Attaches a file for each `<mcap>` of the recording plugins in the world's SDF, whichever plugin
/// is loaded first. What can't be written is one error of Gazebo's.
Recordings attach_recordings(gazebo::physics::World& world, Outlets& outlets);

/// Puts the files into their places, once nothing more is told. What fails is one error of
/// Gazebo's.
void finish(const Recordings& recordings);

}  // namespace tagfield
