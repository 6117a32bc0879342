// SPDX-License-Identifier: Apache-2.0
/// @file
/// The tags and antennas of a gz-sim world, and their updates in simulated time.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "adapters/gazebo_common/tag_set.h"
#include "adapters/gz/static_solids.h"
#include "tagfield/field/field_driver.h"
#include "tagfield/field/field_worker.h"

namespace tagfield {

/// Drives a field by gz-sim: after each step it checks which custom sensors were added or removed
/// and which antennas are due by simulated time, collects the poses of all tags and of those
/// antennas, and passes them to a FieldWorker. An update is stamped with the time of its step, so
/// reads don't depend on Gazebo's speed. Not thread-safe: gz-sim calls a system's updates one after
/// the other.
class GzField {
 public:
  GzField(Outlets outlets, RadioWorldOptions materials);

  /// To be called after physics, with the state of the entities at `now`. While the world is
  /// paused, only additions and removals are processed.
  void after_step(Time now, bool is_paused, const gz_sim::EntityComponentManager& ecm);
  /// For a world that starts over: all sensors are searched for again in the next step.
  void forget_sensors();

  /// Time that updates took, for benchmarks.
  struct Cost {
    std::int64_t updates = 0;  ///< Antenna updates, in steps that add no tag.
    double step_s = 0.0;       ///< Wall time for which they blocked gz-sim.
    WorkDone work;
  };
  /// Finishes all pending work and returns its cost; no step may follow.
  [[nodiscard]] Cost finish();

 private:
  struct TagGroup {
    gz_sim::Entity sensor = gz_sim::kNullEntity;
    gz_sim::Entity link = gz_sim::kNullEntity;
    gz_math::Pose3d X_WL;    ///< As last reported.
    bool is_placed = false;  ///< Whether its tags have a pose.
    std::vector<TagOnLink> tags;
    std::vector<std::uint32_t> numbers;
  };
  struct Antenna {
    gz_sim::Entity sensor = gz_sim::kNullEntity;
    gz_sim::Entity link = gz_sim::kNullEntity;
    std::optional<gz_sim::Entity> parent;  ///< None for the world.
    bool reports_pose = false;
    RigidTransform X_LA;
  };

  void find_sensors(Time now, const gz_sim::EntityComponentManager& ecm);
  void add_sensor(gz_sim::Entity sensor, const sdf::Sensor& description, Time now,
                  const gz_sim::EntityComponentManager& ecm);
  void add_antenna(gz_sim::Entity sensor, const sdf::ElementPtr& element, Time now,
                   const gz_sim::EntityComponentManager& ecm);
  void add_tag(gz_sim::Entity sensor, const sdf::ElementPtr& element,
               const gz_sim::EntityComponentManager& ecm);
  void add_tag_set(gz_sim::Entity sensor, const sdf::ElementPtr& element,
                   const gz_sim::EntityComponentManager& ecm);
  void add_group(gz_sim::Entity sensor, std::vector<TagOnLink> tags,
                 const gz_sim::EntityComponentManager& ecm);
  void remove_sensor(gz_sim::Entity sensor);
  void place_tags(Time now, const gz_sim::EntityComponentManager& ecm);
  static Antenna mounted(gz_sim::Entity sensor, FieldAntenna& field,
                         const gz_sim::EntityComponentManager& ecm);
  void place(AntennaDue& due, const gz_sim::EntityComponentManager& ecm) const;
  void gather_world(FieldStep& step, const gz_sim::EntityComponentManager& ecm);

  RadioWorldOptions materials_;
  StaticSolids solids_;
  std::vector<TagGroup> groups_;             ///< In ascending order of sensors.
  std::map<std::string, Antenna> antennas_;  ///< By name.
  /// Names of the tag sensors of each model.
  std::map<gz_sim::Entity, std::vector<std::string>> tags_in_;
  bool has_looked_ = false;
  FieldDriver driver_;
  Time last_ = Time::min();
  Cost cost_;
  FieldWorker worker_;
};

}  // namespace tagfield
