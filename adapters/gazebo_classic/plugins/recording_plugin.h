// SPDX-License-Identifier: Apache-2.0
/// @file
/// libTagfieldRecordingPlugin.so: records a world to MCAP files, as rosbag2 would in ROS 2.
///
///     <world name="default">
///       <plugin name="recording" filename="libTagfieldRecordingPlugin.so">
///         <mcap>run.mcap</mcap>   <!-- path, relative to Gazebo's working folder; any number -->
///       </plugin>
///     </world>
///
/// The topics are those of docs/ros2.md: /rfid/reads, /rfid/truth/…, /rfid/markers, /tf,
/// /tf_static, /clock; and for each robot odom, ground_truth/odom and scan in its namespace. A file
/// gets its name when Gazebo ends; until then, and if Gazebo is killed, it is PATH.PID.partial.
/// Invalid input causes one error that names plugin and element.
#pragma once

#include <gazebo/common/Plugin.hh>
#include <memory>

#include "adapters/gazebo_classic/rfid_world.h"

namespace gazebo {

class TagfieldRecordingPlugin : public WorldPlugin {
 public:
  void Load(physics::WorldPtr world, sdf::ElementPtr plugin) override;

 private:
  std::shared_ptr<tagfield::RfidWorld> world_;
};

}  // namespace gazebo
