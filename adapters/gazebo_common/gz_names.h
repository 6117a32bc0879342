// SPDX-License-Identifier: Apache-2.0
/// @file
/// All differences between Gazebo versions: Gazebo 11 and Fortress use the name "ignition",
/// Harmonic, Ionic and Jetty "gz". TAGFIELD_GZ_SIM is the major version of gz-sim (6 for Fortress,
/// 8, 9, 10); it is undefined in Gazebo 11 and where only messages are sent.
#pragma once

#if defined(TAGFIELD_GZ_IS_IGNITION)
#include <ignition/math/Pose3.hh>
namespace tagfield {
namespace gz_math = ignition::math;
}
#else
#include <gz/math/Pose3.hh>
namespace tagfield {
namespace gz_math = gz::math;
}
#endif

// Messages, if a file needs them.
#if defined(TAGFIELD_GZ_TRANSPORT) && defined(TAGFIELD_GZ_IS_IGNITION)
#include <ignition/msgs/marker.pb.h>

#include <ignition/msgs/Utility.hh>
#include <ignition/transport/Node.hh>
namespace tagfield {
namespace gz_msgs = ignition::msgs;
namespace gz_transport = ignition::transport;
}  // namespace tagfield
#elif defined(TAGFIELD_GZ_TRANSPORT)
#include <gz/msgs/marker.pb.h>

#include <gz/msgs/Utility.hh>
#include <gz/transport/Node.hh>
namespace tagfield {
namespace gz_msgs = gz::msgs;
namespace gz_transport = gz::transport;
}  // namespace tagfield
#endif

#if defined(TAGFIELD_GZ_SIM) && TAGFIELD_GZ_SIM == 6
#include <ignition/msgs/twist.pb.h>

#include <ignition/common/Console.hh>
#include <ignition/common/Mesh.hh>
#include <ignition/common/MeshManager.hh>
#include <ignition/common/SubMesh.hh>
#include <ignition/common/SystemPaths.hh>
#include <ignition/common/Util.hh>
#include <ignition/gazebo/EntityComponentManager.hh>
#include <ignition/gazebo/EventManager.hh>
#include <ignition/gazebo/Events.hh>
#include <ignition/gazebo/System.hh>
#include <ignition/gazebo/Util.hh>
#include <ignition/gazebo/components/Collision.hh>
#include <ignition/gazebo/components/CustomSensor.hh>
#include <ignition/gazebo/components/Geometry.hh>
#include <ignition/gazebo/components/Joint.hh>
#include <ignition/gazebo/components/JointPositionReset.hh>
#include <ignition/gazebo/components/Link.hh>
#include <ignition/gazebo/components/Material.hh>
#include <ignition/gazebo/components/Model.hh>
#include <ignition/gazebo/components/Name.hh>
#include <ignition/gazebo/components/ParentEntity.hh>
#include <ignition/gazebo/components/Pose.hh>
#include <ignition/gazebo/components/Static.hh>
#include <ignition/gazebo/components/Visual.hh>
#include <ignition/gazebo/components/World.hh>
namespace tagfield {
namespace gz_sim = ignition::gazebo;
namespace gz_common = ignition::common;
/// Fortress only rewinds time and never calls this.
class ISystemReset {
 public:
  ISystemReset() = default;
  virtual ~ISystemReset() = default;
  ISystemReset(const ISystemReset&) = delete;
  ISystemReset& operator=(const ISystemReset&) = delete;
  virtual void Reset(const gz_sim::UpdateInfo& info, gz_sim::EntityComponentManager& ecm) = 0;
};
// Without the source location that `ignerr` would add: the line states the location in the world.
inline void tell_error(const std::string& line) { gz_common::Console::err() << line << "\n"; }
inline void report_warning(const std::string& line) { gz_common::Console::warn() << line << "\n"; }
}  // namespace tagfield
#define TAGFIELD_ADD_SYSTEM(type, ...) \
  IGNITION_ADD_PLUGIN(type, tagfield::gz_sim::System, __VA_ARGS__)
#elif defined(TAGFIELD_GZ_SIM)
#include <gz/msgs/twist.pb.h>

#include <gz/common/Console.hh>
#include <gz/common/Mesh.hh>
#include <gz/common/MeshManager.hh>
#include <gz/common/SubMesh.hh>
#include <gz/common/SystemPaths.hh>
#include <gz/common/Util.hh>
#include <gz/sim/EntityComponentManager.hh>
#include <gz/sim/EventManager.hh>
#include <gz/sim/Events.hh>
#include <gz/sim/System.hh>
#include <gz/sim/Util.hh>
#include <gz/sim/components/Collision.hh>
#include <gz/sim/components/CustomSensor.hh>
#include <gz/sim/components/Geometry.hh>
#include <gz/sim/components/Joint.hh>
#include <gz/sim/components/JointPositionReset.hh>
#include <gz/sim/components/Link.hh>
#include <gz/sim/components/Material.hh>
#include <gz/sim/components/Model.hh>
#include <gz/sim/components/Name.hh>
#include <gz/sim/components/ParentEntity.hh>
#include <gz/sim/components/Pose.hh>
#include <gz/sim/components/Static.hh>
#include <gz/sim/components/Visual.hh>
#include <gz/sim/components/World.hh>
namespace tagfield {
namespace gz_sim = gz::sim;
namespace gz_common = gz::common;
using gz_sim::ISystemReset;
// Up to Harmonic, without the source location that `gzerr` would add: the line states the location
// in the world. From Ionic on, each message is a line of its own.
#if TAGFIELD_GZ_SIM == 8
inline void tell_error(const std::string& line) { gz_common::Console::err() << line << "\n"; }
inline void report_warning(const std::string& line) { gz_common::Console::warn() << line << "\n"; }
#else
inline void tell_error(const std::string& line) { gzerr << line; }
inline void report_warning(const std::string& line) { gzwarn << line; }
#endif
}  // namespace tagfield
#define TAGFIELD_ADD_SYSTEM(type, ...) GZ_ADD_PLUGIN(type, tagfield::gz_sim::System, __VA_ARGS__)
#endif

// The first source file that registers a system defines TAGFIELD_FIRST_SYSTEM, the others
// TAGFIELD_NEXT_SYSTEM.
#if defined(TAGFIELD_FIRST_SYSTEM) && defined(TAGFIELD_GZ_IS_IGNITION)
#include <ignition/plugin/Register.hh>
#elif defined(TAGFIELD_FIRST_SYSTEM)
#include <gz/plugin/Register.hh>
#elif defined(TAGFIELD_NEXT_SYSTEM) && defined(TAGFIELD_GZ_IS_IGNITION)
#include <ignition/plugin/RegisterMore.hh>
#elif defined(TAGFIELD_NEXT_SYSTEM)
#include <gz/plugin/RegisterMore.hh>
#endif
