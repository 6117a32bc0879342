// SPDX-License-Identifier: Apache-2.0
/// @file
/// The headless driver of a field: a clock with a fixed step, robots, lifts, and tags that move and
/// come and go; and how to run it, as opposed to what.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tagfield/field/field_driver.h"
#include "tagfield/field/rfid_field.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

struct MovingBody;
class NavigationListener;
class Robot;
class TagSchedule;
struct RadioWorld;
struct RemoteDriving;
struct SelfDriving;

/// Threads, progress, and an early end.
struct RunControl {
  int threads = 1;
  const std::atomic<bool>* stop = nullptr;        ///< Set by others to end early.
  std::function<void(double share)> on_progress;  ///< Called now and then with 0 … 1, or empty.
  /// Likewise by what comes after the simulation, from any thread, with what it is.
  std::function<void(const std::string& stage, double share)> on_stage;
  Outlets outlets;                                 ///< Told of the first seed's run, as it goes.
  std::shared_ptr<NavigationListener> navigation;  ///< Of that run, too; or null.
  const RemoteDriving* remote = nullptr;           ///< Who drives a robot from outside, if anybody.
  bool keeps_recording = true;  ///< Else memory does not grow with the run, and nothing is located.
};

/// Whether the run is to end early.
inline bool stopped(const RunControl& control) { return control.stop != nullptr && *control.stop; }

/// Runs a scenario step by step and tells its outlets what comes of it. Tags and antennas can be
/// added and removed between any two steps. The same scenario and seed tell the same.
class Simulation {
 public:
  /// Robots that have anywhere to go drive there by themselves where `driving` is given; what it
  /// points to must outlive this. Throws Error on a scenario that can't be simulated: an ID used
  /// twice, an unknown robot, a parameter out of range. Where `remote` is given it drives one
  /// robot, and the run ends with the scenario's duration, or never.
  Simulation(const Scenario& scenario, std::uint64_t seed, Outlets outlets = {},
             const SelfDriving* driving = nullptr, const RemoteDriving* remote = nullptr);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Goes on by one time step. Reads are stamped with the time of their antenna's update, or of the
  /// tag's answer, wherever in the step that falls.
  void step();
  /// Likewise, but antennas don't update: nothing is read or told.
  void skip_step();
  /// Tells what is kept back so that reads come in order of time; the last step does so by itself.
  void finish() { field_.finish(); }

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
  /// Likewise what moves and is in waves' way: robots and obstacles that have a material.
  [[nodiscard]] std::vector<MovingBody> bodies_at(Time stamp) const;

  /// Adds a tag now (its `appears` does not matter). Throws Error if the ID is present, or its
  /// robot unknown.
  void add_tag(const TagSpec& tag);
  /// Throws Error if there is no such tag.
  void remove_tag(const std::string& id);
  [[nodiscard]] bool has_tag(const std::string& id) const { return tags_.count(id) > 0; }
  /// The tag rests there from now on, on no robot. Throws Error if there is no such tag.
  void move_tag(const std::string& id, const RigidTransform& X_WT);
  /// Adds an antenna, to be heard from its first update from now on. Throws Error if the name is
  /// present, its robot unknown, or a parameter out of range.
  void add_antenna(const AntennaSpec& antenna);
  /// Throws Error if there is no such antenna.
  void remove_antenna(const std::string& name);
  /// The antenna's update now, besides those at its rate: what an inventory has read until now is
  /// told, or it begins. Throws Error if there is no such antenna.
  void update_antenna(const std::string& name);
  /// Something in waves' way, where it has a body, from now on.
  void add_obstacle(const ObstacleSpec& obstacle);
  /// Nothing where there is no such obstacle.
  void remove_obstacle(const std::string& name);

 private:
  void begin_step();
  void handle_events(Time until);
  void hold_tag(std::uint32_t number);
  void update_at(Time stamp);
  void update(std::vector<AntennaDue> due, Time stamp);
  void place(AntennaDue& due, Time stamp) const;
  [[nodiscard]] double seconds_into_step(Time stamp) const;

  std::uint64_t seed_;
  Duration time_step_;
  std::optional<Time> end_;
  Time now_{};         ///< End of the last step.
  Time step_begin_{};  ///< Beginning of the last step.
  std::vector<Robot> robots_;
  std::vector<std::pair<std::string, RobotBody>> robot_bodies_;  ///< By robot's name.
  std::vector<ObstacleSpec> obstacles_;                          ///< Those that have a body.
  std::unordered_map<std::string, AntennaSpec> antennas_;
  std::unordered_map<std::string, std::uint32_t> tags_;         ///< Numbers by ID.
  std::vector<std::pair<std::uint32_t, TagSpec>> moving_tags_;  ///< In rising order of numbers.
  std::unique_ptr<TagSchedule> schedule_;
  FieldDriver driver_;
  RfidField field_;
};

/// The scenario's world as waves see it; empty space where it has none.
std::shared_ptr<const RadioWorld> radio_world_of(const Scenario& scenario);

}  // namespace tagfield
