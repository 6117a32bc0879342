/// @file
/// The headless simulator: a clock with a fixed step, robots, antennas and tags.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/field/radio_air.h"
#include "tagfield/field/tag_population.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/simulator/robot.h"
#include "tagfield/stream/truth.h"

namespace tagfield {

/// What a run yields, in order of time.
struct Recording {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> believed_poses;  ///< A fixed antenna has one row.
  Truth truth;
};

/// What a robot that finds its way by itself begins with.
struct SelfDriving {
  const NavigationWorld* world = nullptr;
  const OccupancyGrid* map = nullptr;
  PlanarPose true_start;  ///< Of the robot that mapped; others begin where they are put.
  PoseEstimate start;     ///< What that robot believes of it, where it is told.
};

/// Runs a scenario step by step. Tags and antennas can be added and removed between any two steps.
/// The same scenario and seed give the same recording.
class Simulation {
 public:
  /// Throws Error on a scenario that can't be simulated: an ID used twice, an unknown robot, a
  /// parameter out of range.
  Simulation(const Scenario& scenario, std::uint64_t seed);
  /// Robots that have anywhere to go drive there by themselves. What `driving` points to must
  /// outlive this.
  Simulation(const Scenario& scenario, const SelfDriving& driving, std::uint64_t seed);

  /// Goes on by one time step and appends to `recording` what came of it. Reads are stamped with
  /// the time of their antenna's update, wherever in the step that falls.
  void step(Recording& recording);
  /// Likewise, but antennas don't update: nothing is read or recorded.
  void skip_step();

  /// Time that the next step begins at.
  [[nodiscard]] Time now() const { return now_; }
  /// Whether the scenario's duration is over, or all robots have arrived.
  [[nodiscard]] bool finished() const;
  /// Share done, 0 to 1: of the duration where it is set, else of the slowest robot's way.
  [[nodiscard]] double progress() const;
  /// Way driven by all robots [m].
  [[nodiscard]] double travelled_m() const;
  [[nodiscard]] const std::vector<Robot>& robots() const { return robots_; }
  /// Where an antenna, or a tag, truly is at `stamp` within the last step, its end included; before
  /// the first step at 0. It need not have been added, but its robot must be there. A recorded
  /// antenna is where its last row says.
  [[nodiscard]] RigidTransform antenna_pose(const AntennaSpec& antenna, Time stamp) const;
  [[nodiscard]] RigidTransform tag_pose(const TagSpec& tag, Time stamp) const;

  /// Adds a tag now (its `appears` does not matter). Throws Error if the ID is present, or its
  /// robot unknown.
  void add_tag(const TagSpec& tag);
  /// Throws Error if there is no such tag.
  void remove_tag(const std::string& id);
  /// Adds an antenna, to be heard from its first update from now on. Throws Error if the name is
  /// present, its robot unknown, or a parameter out of range.
  void add_antenna(const AntennaSpec& antenna);
  /// Throws Error if there is no such antenna.
  void remove_antenna(const std::string& name);

 private:
  struct Update {
    Time stamp;
    std::size_t antenna = 0;
  };

  Simulation(const Scenario& scenario, const SelfDriving* driving, std::uint64_t seed);
  void begin_step();
  void plan_appearances(const std::vector<TagSpec>& tags);
  [[nodiscard]] std::vector<Time> stamps_in_step(const AntennaSpec& antenna) const;
  [[nodiscard]] std::vector<Update> updates_in_step() const;
  void handle_events(Time until);
  void record_new_tags(Recording& recording);
  void move_tags(Time stamp, Recording& recording);
  void update_antenna(const Update& update, Recording& recording);
  /// True pose of the antenna, recorded with the believed one.
  RigidTransform place_antenna(const AntennaSpec& antenna, Time stamp, Recording& recording);
  void record_robots(Time stamp, Recording& recording);
  [[nodiscard]] const Robot* robot_named(const std::string& name) const;
  [[nodiscard]] double seconds_into_step(Time stamp) const;
  std::uint32_t place_new(const TagSpec& tag);
  void require_robot(const std::string& name, const Location& location) const;

  std::uint64_t seed_;
  Duration time_step_;
  std::optional<Time> end_;
  Time now_{};         ///< End of the last step.
  Time step_begin_{};  ///< Beginning of the last step.
  std::vector<Robot> robots_;
  std::vector<AntennaSpec> antennas_;
  std::vector<std::string> recorded_fixed_;  ///< Fixed antennas whose pose is recorded.
  TagPopulation tags_;
  RadioAir air_;                             ///< Antennas of physical models.
  std::vector<TagSpec> specs_;               ///< By slot.
  std::vector<std::uint32_t> moving_slots_;  ///< Rising.
  std::vector<std::uint32_t> new_slots_;     ///< Tags at rest whose place is not recorded yet.
  std::vector<TagSpec> to_appear_;           ///< Latest first.
  std::vector<std::pair<Time, std::string>> to_disappear_;  ///< Latest first.
  std::vector<TagReply> replies_;                           ///< Kept to save allocations.
  Time moved_to_ = Time::min();
};

/// The scenario's world as waves see it; empty space where it has none.
std::shared_ptr<const RadioWorld> radio_world_of(const Scenario& scenario);

/// What a robot believes that was put at `pose` by hand: within 2 cm and 0.6°, one sigma.
PoseEstimate placed_at(const PlanarPose& pose);

}  // namespace tagfield
