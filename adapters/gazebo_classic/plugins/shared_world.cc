#include "adapters/gazebo_classic/plugins/shared_world.h"

#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <map>
#include <mutex>
#include <utility>

#include "adapters/gazebo_classic/window_markers.h"
#include "adapters/ros1/rfid_markers.h"
#include "adapters/ros1/rfid_publisher.h"

namespace tagfield {
namespace {

std::shared_ptr<RfidWorld> make_world(const gazebo::physics::WorldPtr& world) {
  const std::shared_ptr<RosLink> link = RosLink::shared();
  if (!link->fault().empty()) gzerr << "Tagfield: no ROS: " << link->fault() << "\n";
  std::vector<std::unique_ptr<FieldListener>> listeners;
  listeners.push_back(std::make_unique<RfidPublisher>(link));
  listeners.push_back(std::make_unique<RfidMarkers>(link));
  listeners.push_back(std::make_unique<WindowMarkers>());
  return std::make_shared<RfidWorld>(world, std::move(listeners),
                                     [link](Time now) { link->advance_clock(now); });
}

}  // namespace

std::shared_ptr<RfidWorld> shared_rfid_world(const gazebo::physics::WorldPtr& world) {
  // Gazebo gives sensor plugins no place to meet, so they meet here, by their world's name. Nothing
  // is kept beyond its users.
  static std::mutex mutex;
  static std::map<std::string, std::weak_ptr<RfidWorld>> worlds;
  const std::lock_guard lock(mutex);
  std::shared_ptr<RfidWorld> shared = worlds[world->Name()].lock();
  if (!shared) {
    shared = make_world(world);
    worlds[world->Name()] = shared;
  }
  return shared;
}

}  // namespace tagfield
