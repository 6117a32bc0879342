// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario that goes on while others look at it, change it and drive its readers.
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

/// Takes part in a live world. All calls come from the thread that runs it.
class LiveMember {
 public:
  LiveMember() = default;
  virtual ~LiveMember() = default;
  LiveMember(const LiveMember&) = delete;
  LiveMember& operator=(const LiveMember&) = delete;

  /// After each step, all reads up to `now` that can be told having been told.
  virtual void on_step(LiveWorld& world, Time now) = 0;
  /// After tasks were done, and while it is paused now and then.
  virtual void on_tasks(LiveWorld& /*world*/) {}
};

/// An antenna of a live world, as it is now.
struct LiveAntenna {
  AntennaSpec spec;   ///< As the scenario, or whoever added it, says.
  bool is_on = true;  ///< It sends. Else its reader's duty leaves it out, or it is disconnected.
  bool is_faulty = false;  ///< Disconnected: no duty switches it on.
  /// Of its reader's ports, 1 or more: in the order in which they were first there. One that was
  /// taken away leaves its port empty, and gets it again.
  int port = 1;
};

/// Where it is now.
struct LivePose {
  std::string name;
  RigidTransform X_W;
};

/// How a live world goes on.
struct LiveOptions {
  double speed = 1.0;      ///< Multiple of real time; 0 for as fast as it can.
  bool is_paused = false;  ///< At first.
  /// Whether readers read from the start, as the scenario says; else each waits for its duty.
  bool readers_start = true;
};

/// Simulates a scenario without end: robots that have arrived stand still. All members but post()
/// are for the thread that runs it: in tasks, and in LiveMember::on_step().
class LiveWorld {
 public:
  using Task = std::function<void(LiveWorld& world)>;

  /// `outlets` are told what is read, as of any other driver. Throws Error as Simulation does.
  LiveWorld(const Scenario& scenario, std::uint64_t seed, Outlets outlets, LiveOptions options);
  ~LiveWorld();

  /// Who takes part; before run().
  void attach(std::shared_ptr<LiveMember> member);
  /// From any thread: done between two steps, in the order of posting; soon even when paused. A
  /// task must not throw. After run() has returned it is dropped.
  void post(Task task);
  /// Steps, and does tasks, until `stop`.
  void run(const std::atomic<bool>& stop);

  [[nodiscard]] Time now() const;
  /// Grows whenever tags, antennas or obstacles come, go or are put elsewhere by those who use
  /// this.
  [[nodiscard]] std::uint64_t revision() const;
  [[nodiscard]] const Scenario& scenario() const;  ///< With all changes made since.
  [[nodiscard]] double speed() const;
  /// How fast it goes on, as a multiple of real time, over the last second or so; 0 when paused.
  [[nodiscard]] double pace() const;
  [[nodiscard]] bool is_paused() const;
  void set_speed(double speed);  ///< Throws Error unless it is 0 or more, and finite.
  void pause();
  void resume();
  /// Goes on by so much, and is paused again then.
  void advance(Duration simulated);

  // All throw Error, one line, where the name is not known or taken, or a value is out of range.

  void add_tag(const TagSpec& tag);
  void remove_tag(const std::string& id);
  /// To rest there from now on.
  void move_tag(const std::string& id, const RigidTransform& X_WT);
  /// So much loss by what it is mounted on, each way, instead of what it had [dB].
  void detune_tag(const std::string& id, double detuning_db);
  [[nodiscard]] std::vector<LivePose> tags() const;
  /// Those that move, or ride on a robot.
  [[nodiscard]] std::vector<LivePose> moving_tags() const;

  void add_antenna(const AntennaSpec& antenna);
  void remove_antenna(const std::string& name);
  void move_antenna(const std::string& name, const RigidTransform& X_WA);
  /// A cable that is off, or on again.
  void set_antenna_faulty(const std::string& name, bool is_faulty);
  [[nodiscard]] const std::vector<LiveAntenna>& antennas() const;
  [[nodiscard]] RigidTransform antenna_pose(const LiveAntenna& antenna) const;

  /// Names, in the order of the antennas.
  [[nodiscard]] std::vector<std::string> readers() const;
  /// Until the next duty. What the duty asks for that has no effect, as power of antennas of the
  /// paper's model, comes back as warnings.
  std::vector<std::string> set_duty(const std::string& reader, const ReaderDuty& duty);
  /// As the scenario says.
  void reset_duty(const std::string& reader);

  /// Something in waves' way, such as a pallet: an absorbing box or cylinder.
  void add_obstacle(const ObstacleSpec& obstacle);
  void remove_obstacle(const std::string& name);

  [[nodiscard]] std::vector<LivePose> robots() const;
  /// Why the antenna reads the tag now, or not.
  [[nodiscard]] LinkExplanation explain(const std::string& antenna, const std::string& tag) const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
