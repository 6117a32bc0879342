// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tags and antennas of one Gazebo world, and their updates in simulated time.
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

/// Tags that come and go together.
struct TagsOnLink {
  std::string place;  ///< For messages.
  std::string link;   ///< Scoped name.
  /// Called once, when the link is there with its whole model. May throw Error.
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

/// How long updates took, for benchmarks.
struct FieldCost {
  std::int64_t updates = 0;  ///< Of antennas, in steps to which no tag came.
  double physics_s = 0.0;    ///< Wall time that physics waited in them.
  double reads_s = 0.0;      ///< CPU time of the thread that makes and publishes all reads.
  std::int64_t reads = 0;
};

/// One a world: drives a field by Gazebo's physics. At the end of each physics step it looks which
/// antennas are due by simulated time, gathers where all tags and those antennas are, and hands
/// that to a FieldWorker. An update is stamped with the time of its step, so reads don't depend on
/// how fast Gazebo runs.
///
/// Thread-safe: plugins load and unload on other threads than physics, even while physics still
/// puts their model together. So links are given by name and looked up between two steps.
class RfidWorld {
 public:
  using Handle = std::uint64_t;

  /// `on_step` is called with simulated time after each physics step.
  RfidWorld(const gazebo::physics::WorldPtr& world, Outlets outlets,
            std::function<void(Time)> on_step);
  ~RfidWorld();
  RfidWorld(const RfidWorld&) = delete;
  RfidWorld& operator=(const RfidWorld&) = delete;

  /// Adds tags; they are read from the next update on. If they can't be described, or an ID is
  /// taken, that is one error of Gazebo's, and none of them is there.
  Handle add_tags(TagsOnLink tags);
  void remove_tags(Handle handle);

  /// A second antenna on sensors of one name gets its model's in front, as headless. Throws Error
  /// if the name is taken all the same. If its parent frame is no link of its model, that is one
  /// error of Gazebo's, and it stays off.
  Handle add_antenna(AntennaOnLink antenna);
  void remove_antenna(Handle handle);

  /// What the world is made of, for physical models; guessed from names where it is not told.
  /// Throws Error if it was told already.
  void set_materials(RadioWorldOptions materials);

  [[nodiscard]] FieldCost cost() const;

 private:
  /// What is looked up between two steps, as models are whole then.
  struct OnLink {
    gazebo::physics::LinkPtr link;  ///< None until it is found.
    std::optional<Time> faulty_since;
    bool refused = false;  ///< For an error that was told.
  };
  struct TagGroup : OnLink {
    Handle handle = 0;
    TagsOnLink on_link;
    ignition::math::Pose3d X_WL;  ///< When it was told of last.
    bool told = false;            ///< Whether its tags have a place.
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
  std::vector<TagGroup> groups_;  ///< In rising order of handles.
  std::map<Handle, Antenna> antennas_;
  bool all_found_ = true;  ///< All links.
  FieldDriver driver_;
  Time last_ = Time::min();
  FieldCost cost_;
  FieldWorker worker_;
  gazebo::event::ConnectionPtr connection_;
};

}  // namespace tagfield
