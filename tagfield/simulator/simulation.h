// SPDX-License-Identifier: Apache-2.0
/// @file
/// The headless driver of a field: a clock with a fixed step, robots, lifts, and tags that move,
/// appear and disappear; and how to run it, as opposed to what to run.
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
  const std::atomic<bool>* stop = nullptr;        ///< Set by others to end the run early.
  std::function<void(double share)> on_progress;  ///< Called occasionally with 0 … 1; may be empty.
  /// Called in the same way by the stages after the simulation, from any thread, with the stage's
  /// name.
  std::function<void(const std::string& stage, double share)> on_stage;
  Outlets outlets;  ///< Receive the first seed's run while it is simulated.
  std::shared_ptr<NavigationListener> navigation;  ///< For the same run; may be null.
  const RemoteDriving* remote = nullptr;           ///< Remote driver of a robot; null if none.
  bool keeps_recording = true;  ///< Else memory use is constant, and nothing is localized.
};

/// Whether the run is to end early.
inline bool stopped(const RunControl& control) { return control.stop != nullptr && *control.stop; }

/// Runs a scenario step by step and passes the results to its outlets. Tags and antennas can be
/// added and removed between any two steps. The same scenario and seed give the same results.
class Simulation {
 public:
  /// If `driving` is given, robots with waypoints or goals navigate by themselves; what it points
  /// to must outlive this. If `remote` is given, it drives one robot, and the run ends after the
  /// scenario's duration, or never. Paths to many tags are traced on up to `threads` threads, on
  /// which the results don't depend. Throws Error on a scenario that can't be simulated: a
  /// duplicate ID, an unknown robot, a parameter out of range.
  Simulation(const Scenario& scenario, std::uint64_t seed, Outlets outlets = {},
             const SelfDriving* driving = nullptr, const RemoteDriving* remote = nullptr,
             int threads = 1);
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  /// Advances by one time step. Reads are stamped with the time of their antenna's update, or of
  /// the tag's reply, wherever in the step that falls.
  void step();
  /// Same, but antennas don't update: nothing is read or passed on.
  void skip_step();
  /// Passes on the reads that are held back to keep them in chronological order; the last step does
  /// so by itself.
  void finish() { field_.finish(); }
  /// The reader's reads that are held back now, in chronological order.
  [[nodiscard]] std::vector<TagRead> held_reads(const std::string& reader) const {
    return field_.held_reads(reader);
  }

  /// Time at which the next step begins.
  [[nodiscard]] Time now() const { return now_; }
  /// Whether the scenario's duration is over or, if it has none, all robots have arrived.
  [[nodiscard]] bool finished() const;
  /// Share done, 0 to 1: of the duration if it is set, else of the slowest robot's path.
  [[nodiscard]] double progress() const;
  /// Distance driven by all robots [m].
  [[nodiscard]] double travelled_m() const;
  [[nodiscard]] const std::vector<Robot>& robots() const { return robots_; }
  /// True pose of an antenna or a tag at `stamp`, which must be within the last step or at its end,
  /// or 0 before the first step. It need not have been added, but its robot must exist. A recorded
  /// antenna has the pose of its latest row.
  [[nodiscard]] RigidTransform antenna_pose(const AntennaSpec& antenna, Time stamp) const;
  [[nodiscard]] RigidTransform tag_pose(const TagSpec& tag, Time stamp) const;
  /// Same, but of moving bodies that affect waves: robots and obstacles that have a body.
  [[nodiscard]] std::vector<MovingBody> bodies_at(Time stamp) const;

  /// Adds a tag now (its `appears` does not matter). Throws Error if the ID exists or its robot is
  /// unknown.
  void add_tag(const TagSpec& tag);
  /// Throws Error if there is no such tag.
  void remove_tag(const std::string& id);
  [[nodiscard]] bool has_tag(const std::string& id) const { return tags_.count(id) > 0; }
  /// Moves the tag to X_WT, where it then stays, on no robot. Throws Error if there is no such tag.
  void move_tag(const std::string& id, const RigidTransform& X_WT);
  /// Adds an antenna, which updates from now on. Throws Error if the name exists, its robot is
  /// unknown, or a parameter is out of range.
  void add_antenna(const AntennaSpec& antenna);
  /// Throws Error if there is no such antenna.
  void remove_antenna(const std::string& name);
  /// Updates the antenna now, in addition to the updates at its rate: what its inventory has read
  /// until now is passed on, or the inventory begins. Throws Error if there is no such antenna.
  void update_antenna(const std::string& name);
  /// Same for several antennas at once, each of which sees the others where they are now.
  void update_antennas(const std::vector<std::string>& names);
  /// Adds an obstacle to waves from now on, if it has a body.
  void add_obstacle(const ObstacleSpec& obstacle);
  /// Does nothing if there is no such obstacle.
  void remove_obstacle(const std::string& name);

 private:
  void begin_step();
  void handle_events(Time until);
  void hold_tag(std::uint32_t number);
  void read_to_the_end();
  [[nodiscard]] Time last_instant() const;
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
  std::vector<std::pair<std::string, RobotBody>> robot_bodies_;  ///< By the robot's name.
  std::vector<ObstacleSpec> obstacles_;                          ///< Those that have a body.
  std::unordered_map<std::string, AntennaSpec> antennas_;
  std::unordered_map<std::string, std::uint32_t> tags_;         ///< Numbers by ID.
  std::vector<std::pair<std::uint32_t, TagSpec>> moving_tags_;  ///< In ascending order of numbers.
  std::unique_ptr<TagSchedule> schedule_;
  FieldDriver driver_;
  RfidField field_;
};

/// The scenario's world as seen by waves; free space if it has none.
std::shared_ptr<const RadioWorld> radio_world_of(const Scenario& scenario);

}  // namespace tagfield
