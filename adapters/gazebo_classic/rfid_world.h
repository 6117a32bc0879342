// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tags and antennas of a Gazebo world, and their updates in simulated time.
#pragma once

#include <cstdint>
#include <functional>
#include <gazebo/common/Events.hh>
#include <gazebo/physics/PhysicsTypes.hh>
#include <ignition/math/Pose3.hh>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "adapters/gazebo_classic/static_scene.h"
#include "adapters/gazebo_common/tag_set.h"
#include "tagfield/field/field_driver.h"
#include "tagfield/field/field_worker.h"

namespace tagfield {

/// Tags that are added and removed together.
struct TagsOnLink {
  std::string place;  ///< For messages.
  std::string link;   ///< Scoped name.
  /// Called once, when the link exists with its whole model. May throw Error.
  std::function<std::vector<TagOnLink>(gazebo::physics::Link&)> describe;
};

/// An antenna fixed to a link.
struct AntennaOnLink {
  std::string place;  ///< For messages.
  FieldAntenna antenna;
  std::string link;  ///< Scoped name.
  RigidTransform X_LA;
  std::string model{};  ///< Scoped name of its model.
};

/// Time that updates took, for benchmarks.
struct FieldCost {
  std::int64_t updates = 0;  ///< Antenna updates, in steps that add no tag.
  double physics_s = 0.0;    ///< Wall time for which they blocked physics.
  double reads_s = 0.0;      ///< CPU time of the thread that generates and publishes all reads.
  std::int64_t reads = 0;
};

/// Drives a field by Gazebo's physics; one per world. At the end of each physics step it checks
/// which antennas are due by simulated time, collects the poses of all tags and of those antennas,
/// and passes them to a FieldWorker. An update is stamped with the time of its step, so reads don't
/// depend on Gazebo's speed.
///
/// Thread-safe: plugins are loaded and unloaded on other threads than physics, even while physics
/// is still assembling their model. So links are given by name and looked up between two steps.
class RfidWorld {
 public:
  using Handle = std::uint64_t;

  /// `on_step` is called with simulated time after each physics step.
  RfidWorld(const gazebo::physics::WorldPtr& world, Outlets outlets,
            std::function<void(Time)> on_step);
  ~RfidWorld();
  RfidWorld(const RfidWorld&) = delete;
  RfidWorld& operator=(const RfidWorld&) = delete;

  /// Adds tags; they are read from the next update on. If they can't be described or an ID is
  /// already in use, none of them is added, and Gazebo reports one error.
  Handle add_tags(TagsOnLink tags);
  void remove_tags(Handle handle);

  /// If an antenna on a sensor of the same name exists already, the new one's name is prefixed with
  /// its model's, as in headless runs. Throws Error if that name is also taken. If its parent frame
  /// is not a link of its model, Gazebo reports one error and the antenna stays off.
  Handle add_antenna(AntennaOnLink antenna);
  void remove_antenna(Handle handle);

  /// The materials of the world, for physical models; those not given are guessed from names.
  /// Throws Error if called twice.
  void set_materials(RadioWorldOptions materials);

  [[nodiscard]] FieldCost cost() const;

 private:
  /// Looked up between two steps, when models are complete.
  struct OnLink {
    gazebo::physics::LinkPtr link;  ///< None until it is found.
    std::optional<Time> faulty_since;
    bool refused = false;  ///< An error was reported.
  };
  struct TagGroup : OnLink {
    Handle handle = 0;
    TagsOnLink on_link;
    ignition::math::Pose3d X_WL;  ///< As last reported.
    bool placed = false;          ///< Whether its tags have a pose.
    std::vector<TagOnLink> tags;
    std::vector<std::uint32_t> numbers;
  };
  struct Antenna : OnLink {
    AntennaOnLink on_link;
    gazebo::physics::LinkPtr parent;  ///< None for the world.
  };

  void after_step();
  void find_links(Time now);
  template <class Entry, class SetUp>
  void find_link(Entry& entry, Time now, const SetUp& set_up, const char* consequence);
  void describe(TagGroup& group);
  void set_up(Antenna& antenna, Time now);
  FieldStep gather(Time now);
  void gather_world(FieldStep& step);
  void place_tags(Time now);
  void place(AntennaDue& due) const;

  gazebo::physics::WorldPtr world_;
  StaticScene solids_;
  std::optional<RadioWorldOptions> materials_;
  std::function<void(Time)> on_step_;
  mutable std::mutex mutex_;
  Handle next_handle_ = 1;
  std::vector<TagGroup> groups_;  ///< In ascending order of handles.
  std::map<Handle, Antenna> antennas_;
  bool all_found_ = true;  ///< All links.
  FieldDriver driver_;
  Time last_ = Time::min();
  FieldCost cost_;
  FieldWorker worker_;
  gazebo::event::ConnectionPtr connection_;
};

}  // namespace tagfield
