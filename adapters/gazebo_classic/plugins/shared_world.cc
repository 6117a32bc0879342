// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/plugins/shared_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/World.hh>
#include <iostream>
#include <map>
#include <mutex>
#include <utility>

#include "adapters/gazebo_classic/plugins/recording.h"
#include "adapters/gazebo_common/window_markers.h"
#include "adapters/ros1/rfid_markers.h"
#include "adapters/ros1/rfid_publisher.h"
#include "adapters/ros2/ros2_outlet.h"

namespace tagfield {
namespace {

/// For benchmarks: reports the cost of an update when the world's last plugin is unloaded.
void report_cost(const RfidWorld& world) {
  if (std::getenv("TAGFIELD_REPORT_COST") == nullptr) return;
  const FieldCost cost = world.cost();
  const double updates = static_cast<double>(std::max<std::int64_t>(cost.updates, 1));
  std::cout << fmt::format(
      "{{\"updates\": {}, \"physics_ms\": {:.4f}, \"reads_ms\": {:.4f}, \"reads\": {}}}\n",
      cost.updates, 1e3 * cost.physics_s / updates, 1e3 * cost.reads_s / updates, cost.reads);
}

std::shared_ptr<RfidWorld> make_world(const gazebo::physics::WorldPtr& world) {
  const std::shared_ptr<RosLink> link = RosLink::shared();
  if (!link->fault().empty()) gzerr << "Tagfield: no ROS: " << link->fault() << "\n";
  Outlets outlets;
  attach(std::make_shared<RfidPublisher>(link), outlets);
  attach(std::make_shared<RfidMarkers>(link), outlets);
  attach(std::make_shared<WindowMarkers>(), outlets);
  if (const auto recording = shared_recording(world)) {
    attach(std::make_shared<ros2::Ros2Outlet>(recording), outlets);
    attach(std::make_shared<ros2::Ros2Markers>(recording), outlets);
  }
  const auto on_step = [link](Time now) { link->advance_clock(now); };
  const auto delete_and_report = [](RfidWorld* old) {
    report_cost(*old);
    delete old;
  };
  return {new RfidWorld(world, std::move(outlets), on_step), delete_and_report};
}

}  // namespace

std::shared_ptr<RfidWorld> shared_rfid_world(const gazebo::physics::WorldPtr& world) {
  // Gazebo offers sensor plugins no shared state, so they share it here, by their world's name.
  // Nothing is kept longer than its users.
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
