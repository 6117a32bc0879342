// SPDX-License-Identifier: Apache-2.0
/// @file
/// A running scenario that clients can observe and change, and whose readers they can control.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/live/reader_duty.h"
#include "tagfield/planning/link_explanation.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

class LiveWorld;

/// Participant in a live world. All calls come from the thread that runs it.
class LiveMember {
 public:
  LiveMember() = default;
  virtual ~LiveMember() = default;
  LiveMember(const LiveMember&) = delete;
  LiveMember& operator=(const LiveMember&) = delete;

  /// Called after each step, once all reads available up to `now` have been delivered.
  virtual void on_step(LiveWorld& world, Time now) = 0;
  /// Called after tasks were done, and from time to time while paused.
  virtual void on_tasks(LiveWorld& /*world*/) {}
  /// Called before a tag is added; throws Error on one that this participant can't cope with.
  virtual void check_new_tag(const LiveWorld& /*world*/, const TagSpec& /*tag*/) {}
};

/// An antenna of a live world, as it is now.
struct LiveAntenna {
  AntennaSpec spec;        ///< As given by the scenario or by add_antenna().
  bool is_on = true;       ///< It transmits: is part of its reader's duty, and connected.
  bool is_faulty = false;  ///< Disconnected: no duty switches it on.
  /// Port of its reader, from 1, in the order in which antennas were first added. A removed antenna
  /// leaves its port empty and gets it back when added again.
  int port = 1;
};

/// A named object's current pose.
struct LivePose {
  std::string name;
  RigidTransform X_W;
};

/// How a live world runs.
struct LiveOptions {
  double speed = 1.0;      ///< Multiple of real time; 0 for as fast as possible.
  bool is_paused = false;  ///< Initially.
  /// Whether readers read from the start, as the scenario says; otherwise each waits for its duty.
  bool readers_start = true;
  int threads = 1;  ///< Of the simulation, which doesn't depend on it.
};

/// Simulates a scenario indefinitely: robots that have arrived stand still. All members except
/// post() must be called from the thread that runs it: in tasks, and in LiveMember::on_step().
class LiveWorld {
 public:
  using Task = std::function<void(LiveWorld& world)>;

  /// `outlets` receive the reads, as from any other driver. Throws Error as Simulation does.
  LiveWorld(const Scenario& scenario, std::uint64_t seed, Outlets outlets, LiveOptions options);
  ~LiveWorld();

  /// Adds a participant; must be called before run().
  void attach(std::shared_ptr<LiveMember> member);
  /// Posts a task, from any thread. Tasks are done between two steps, in the order of posting,
  /// promptly even when paused. They must not throw. After run() has returned they are dropped.
  void post(Task task);
  /// Runs steps and tasks until `stop`.
  void run(const std::atomic<bool>& stop);

  [[nodiscard]] Time now() const;
  /// Increases whenever tags, antennas or obstacles are added, removed or moved through this
  /// interface.
  [[nodiscard]] std::uint64_t revision() const;
  [[nodiscard]] const Scenario& scenario() const;  ///< Including all changes since.
  [[nodiscard]] double speed() const;
  /// Actual speed as a multiple of real time over the last second or so; 0 when paused.
  [[nodiscard]] double pace() const;
  [[nodiscard]] bool is_paused() const;
  void set_speed(double speed);  ///< Throws Error unless it is from 0 to 1e6.
  void pause();
  void resume();
  /// Runs for `simulated`, then pauses again. It runs in whole time steps of the scenario: what one
  /// advance() goes too far, the next one goes less, unless there was a pause() or resume()
  /// between.
  void advance(Duration simulated);
  /// When the step of an advance() ends; none if there is none, or it is over.
  [[nodiscard]] std::optional<Time> step_end() const;

  // All of these throw Error, one line, if a name is unknown or taken, or a value is out of range.

  void add_tag(const TagSpec& tag);
  void remove_tag(const std::string& id);
  /// Moves the tag to rest there from now on.
  void move_tag(const std::string& id, const RigidTransform& X_WT);
  /// Sets the one-way loss due to what the tag is mounted on [dB].
  void detune_tag(const std::string& id, double detuning_db);
  [[nodiscard]] std::vector<LivePose> tags() const;
  /// Tags that move, or ride on a robot.
  [[nodiscard]] std::vector<LivePose> moving_tags() const;

  void add_antenna(const AntennaSpec& antenna);
  void remove_antenna(const std::string& name);
  void move_antenna(const std::string& name, const RigidTransform& X_WA);
  /// Disconnects the antenna's cable, or reconnects it.
  void set_antenna_faulty(const std::string& name, bool is_faulty);
  [[nodiscard]] const std::vector<LiveAntenna>& antennas() const;
  [[nodiscard]] RigidTransform antenna_pose(const LiveAntenna& antenna) const;

  /// Names of the readers, in the order of the antennas.
  [[nodiscard]] std::vector<std::string> readers() const;
  /// Applies until the next duty. Returns warnings about settings that have no effect, such as the
  /// power of antennas with the paper's model.
  std::vector<std::string> set_duty(const std::string& reader, const ReaderDuty& duty);
  /// Resets the reader to what the scenario says.
  void reset_duty(const std::string& reader);
  /// Updates the reader's antennas that take an inventory, in addition to the updates at their
  /// rates: their reads until now are delivered, or held back.
  void update_reader(const std::string& reader);
  /// The reader's reads that the outlets have yet to receive because reads of other readers may
  /// come before them; in chronological order.
  [[nodiscard]] std::vector<TagRead> held_reads(const std::string& reader) const;

  /// Adds an obstruction, such as a pallet: an absorbing box or cylinder.
  void add_obstacle(const ObstacleSpec& obstacle);
  void remove_obstacle(const std::string& name);

  [[nodiscard]] std::vector<LivePose> robots() const;
  /// Robots and obstacles that affect waves, where they are now.
  [[nodiscard]] std::vector<MovingBody> bodies() const;
  /// Explains why the antenna reads the tag now, or why not.
  [[nodiscard]] LinkExplanation explain(const std::string& antenna, const std::string& tag) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
