// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/live_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <condition_variable>
#include <deque>
#include <map>
#include <mutex>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/epc/epc.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/live/internal/live_clock.h"
#include "tagfield/planning/moment.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/simulator/robot.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Three years, longer than anybody waits.
constexpr double kWithoutEnd_s = 1e8;
/// How soon a stop is noticed while nothing is due.
constexpr std::chrono::milliseconds kNap(50);

Scenario without_end(const Scenario& scenario) {
  Scenario endless = scenario;
  endless.duration_s = kWithoutEnd_s;
  return endless;
}

/// The scenario's antennas are added later, one by one.
Scenario without_antennas(const Scenario& scenario) {
  Scenario bare = without_end(scenario);
  bare.antennas.clear();
  return bare;
}

bool takes_inventory(const AntennaParameters& antenna) {
  const RadioModel* const model = physical(antenna);
  return model != nullptr && takes_inventory(*model);
}

void require_finite(const RigidTransform& X, const std::string& whose) {
  // A hall is at most 100 km, as in scenarios.
  if (!is_finite(X) || X.translation.cwiseAbs().maxCoeff() > 1e5) {
    throw Error(fmt::format("{}: the pose must be finite and within 100 km", whose));
  }
}

}  // namespace

class LiveWorld::Impl {
 public:
  Impl(const Scenario& scenario, std::uint64_t seed, Outlets outlets, LiveOptions options)
      : scenario(without_end(scenario)),
        seed(seed),
        clock(options.speed, options.is_paused),
        simulation(without_antennas(scenario), seed, std::move(outlets), nullptr, nullptr,
                   options.threads) {
    for (const AntennaSpec& spec : scenario.antennas) {
      antennas.push_back({spec, false, false, port_of(spec)});
      if (!options.readers_start) duties[spec.parameters.reader] = {};
    }
    for (LiveAntenna& antenna : antennas) apply_duty(antenna);
  }

  void post(Task task);
  void run(LiveWorld& world, const std::atomic<bool>& stop);

  LiveAntenna& antenna_named(const std::string& name);
  TagSpec& tag_with(const std::string& id);
  void require_reader(const std::string& reader) const;
  void check_name(const AntennaSpec& antenna) const;
  int port_of(const AntennaSpec& antenna);
  std::vector<LiveAntenna*> in_turn(const std::string& reader);
  AntennaSpec with_duty(const LiveAntenna& antenna, std::vector<std::string>& warnings) const;
  void apply_duty(LiveAntenna& antenna);
  void switch_on(LiveAntenna& antenna, const AntennaSpec& spec);
  void switch_off(LiveAntenna& antenna);
  [[nodiscard]] Scenario scenario_on_air() const;

  Scenario scenario;
  std::uint64_t seed;
  LiveClock clock;
  Simulation simulation;
  std::vector<LiveAntenna> antennas;
  std::map<std::string, std::vector<std::string>> ports;  ///< All antennas ever added, by reader.
  std::map<std::string, ReaderDuty> duties;  ///< By reader; no entry if it is as the scenario says.
  std::vector<std::shared_ptr<LiveMember>> members;
  std::uint64_t revision = 0;

 private:
  void do_tasks(LiveWorld& world);
  void wait_until(LiveClock::Wall wall);
  void step(LiveWorld& world);

  std::mutex lock_;  ///< Of the following.
  std::condition_variable posted_;
  std::deque<Task> tasks_;
  bool is_over_ = false;
};

void LiveWorld::Impl::post(Task task) {
  {
    const std::lock_guard<std::mutex> guard(lock_);
    if (is_over_) return;
    tasks_.push_back(std::move(task));
  }
  posted_.notify_one();
}

void LiveWorld::Impl::do_tasks(LiveWorld& world) {
  std::deque<Task> tasks;
  {
    const std::lock_guard<std::mutex> guard(lock_);
    tasks.swap(tasks_);
  }
  for (const Task& task : tasks) task(world);
  if (tasks.empty() && !clock.is_paused(simulation.now())) return;
  for (const auto& member : members) member->on_tasks(world);
}

void LiveWorld::Impl::wait_until(LiveClock::Wall wall) {
  std::unique_lock<std::mutex> guard(lock_);
  posted_.wait_until(guard, wall, [this] { return !tasks_.empty(); });
}

void LiveWorld::Impl::step(LiveWorld& world) {
  simulation.step();
  clock.stepped(simulation.now(), std::chrono::steady_clock::now());
  for (const auto& member : members) member->on_step(world, simulation.now());
}

void LiveWorld::Impl::run(LiveWorld& world, const std::atomic<bool>& stop) {
  const Duration length = duration_from_seconds(scenario.time_step_s);
  clock.set_speed(clock.speed(), simulation.now(), std::chrono::steady_clock::now());
  while (!stop) {
    do_tasks(world);
    const LiveClock::Wall wall = std::chrono::steady_clock::now();
    const bool is_paused = clock.is_paused(simulation.now());
    const LiveClock::Wall due = is_paused ? wall + kNap : clock.due(simulation.now() + length);
    if (due > wall) {
      wait_until(std::min(due, wall + kNap));
    } else {
      step(world);
    }
  }
  std::deque<Task> dropped;
  const std::lock_guard<std::mutex> guard(lock_);
  is_over_ = true;
  dropped.swap(tasks_);
}

LiveAntenna& LiveWorld::Impl::antenna_named(const std::string& name) {
  for (LiveAntenna& antenna : antennas) {
    if (antenna.spec.parameters.name == name) return antenna;
  }
  throw Error(fmt::format("there is no antenna called '{}'", name));
}

TagSpec& LiveWorld::Impl::tag_with(const std::string& id) {
  for (TagSpec& tag : scenario.tags) {
    if (tag.id == id && simulation.has_tag(id)) return tag;
  }
  throw Error(fmt::format("there is no tag with the ID '{}'", id));
}

void LiveWorld::Impl::require_reader(const std::string& reader) const {
  const bool is_there = std::any_of(
      antennas.begin(), antennas.end(),
      [&](const LiveAntenna& antenna) { return antenna.spec.parameters.reader == reader; });
  if (!is_there) throw Error(fmt::format("there is no reader called '{}'", reader));
}

/// The antenna with its reader's duty applied.
AntennaSpec LiveWorld::Impl::with_duty(const LiveAntenna& antenna,
                                       std::vector<std::string>& warnings) const {
  AntennaSpec spec = antenna.spec;
  const auto duty = duties.find(spec.parameters.reader);
  if (duty != duties.end()) spec.parameters = on_duty(spec.parameters, duty->second, warnings);
  return spec;
}

/// Switches the antenna according to its reader's duty and its cable.
void LiveWorld::Impl::apply_duty(LiveAntenna& antenna) {
  switch_off(antenna);
  const auto duty = duties.find(antenna.spec.parameters.reader);
  const bool is_asked =
      duty == duties.end() || std::any_of(duty->second.antennas.begin(),
                                          duty->second.antennas.end(), [&](const AntennaDuty& one) {
                                            return one.antenna == antenna.spec.parameters.name;
                                          });
  std::vector<std::string> reported_before;
  if (is_asked && !antenna.is_faulty) switch_on(antenna, with_duty(antenna, reported_before));
}

void LiveWorld::Impl::switch_on(LiveAntenna& antenna, const AntennaSpec& spec) {
  simulation.add_antenna(spec);
  antenna.is_on = true;
  // Its inventory begins now, not at its next update.
  if (takes_inventory(spec.parameters)) simulation.update_antenna(spec.parameters.name);
}

void LiveWorld::Impl::switch_off(LiveAntenna& antenna) {
  if (!antenna.is_on) return;
  const std::string& name = antenna.spec.parameters.name;
  // What it has read since its last update is not lost.
  if (takes_inventory(antenna.spec.parameters)) simulation.update_antenna(name);
  simulation.remove_antenna(name);
  antenna.is_on = false;
}

int LiveWorld::Impl::port_of(const AntennaSpec& antenna) {
  std::vector<std::string>& known = ports[antenna.parameters.reader];
  auto place = std::find(known.begin(), known.end(), antenna.parameters.name);
  if (place == known.end()) place = known.insert(place, antenna.parameters.name);
  return static_cast<int>(place - known.begin()) + 1;
}

/// A reader's antennas in the order of their turns.
std::vector<LiveAntenna*> LiveWorld::Impl::in_turn(const std::string& reader) {
  std::vector<LiveAntenna*> all;
  const auto duty = duties.find(reader);
  if (duty != duties.end()) {
    for (const AntennaDuty& one : duty->second.antennas) {
      all.push_back(&antenna_named(one.antenna));
    }
    return all;
  }
  for (LiveAntenna& antenna : antennas) {
    if (antenna.spec.parameters.reader == reader) all.push_back(&antenna);
  }
  return all;
}

/// The scenario with only the antennas that transmit, as they currently do.
Scenario LiveWorld::Impl::scenario_on_air() const {
  Scenario now = scenario;
  now.antennas.clear();
  std::vector<std::string> reported_before;
  for (const LiveAntenna& antenna : antennas) {
    if (antenna.is_on) now.antennas.push_back(with_duty(antenna, reported_before));
  }
  return now;
}

LiveWorld::LiveWorld(const Scenario& scenario, std::uint64_t seed, Outlets outlets,
                     LiveOptions options)
    : impl_(std::make_unique<Impl>(scenario, seed, std::move(outlets), options)) {}
LiveWorld::~LiveWorld() = default;

void LiveWorld::attach(std::shared_ptr<LiveMember> member) {
  impl_->members.push_back(std::move(member));
}

void LiveWorld::post(Task task) { impl_->post(std::move(task)); }

void LiveWorld::run(const std::atomic<bool>& stop) { impl_->run(*this, stop); }

Time LiveWorld::now() const { return impl_->simulation.now(); }
std::uint64_t LiveWorld::revision() const { return impl_->revision; }
const Scenario& LiveWorld::scenario() const { return impl_->scenario; }
double LiveWorld::speed() const { return impl_->clock.speed(); }
double LiveWorld::pace() const {
  return impl_->clock.pace(now(), std::chrono::steady_clock::now());
}
bool LiveWorld::is_paused() const { return impl_->clock.is_paused(now()); }

std::optional<Time> LiveWorld::step_end() const { return impl_->clock.step_end(now()); }

void LiveWorld::set_speed(double speed) {
  if (!std::isfinite(speed) || speed < 0.0 || speed > 1e6) {
    throw Error("the speed must be from 0 (as fast as it can) to 1e6 times real time");
  }
  impl_->clock.set_speed(speed, now(), std::chrono::steady_clock::now());
}

void LiveWorld::pause() { impl_->clock.pause(); }
void LiveWorld::resume() { impl_->clock.resume(now(), std::chrono::steady_clock::now()); }

void LiveWorld::advance(Duration simulated) {
  if (simulated <= Duration::zero()) throw Error("a step must be longer than 0 s");
  impl_->clock.run_for(simulated, now(), std::chrono::steady_clock::now());
}

void LiveWorld::add_tag(const TagSpec& tag) {
  if (tag.motion.empty()) throw Error(fmt::format("tag '{}' has no position", tag.id));
  for (const StampedPose& pose : tag.motion) require_finite(pose.X_WB, "tag '" + tag.id + "'");
  if (is_epc_uri(tag.id)) epc_from_uri(tag.id);
  for (const auto& member : impl_->members) member->check_new_tag(*this, tag);
  impl_->simulation.add_tag(tag);
  std::vector<TagSpec>& tags = impl_->scenario.tags;
  // Replaces a tag with the same ID that has gone or is still to appear.
  tags.erase(std::remove_if(tags.begin(), tags.end(),
                            [&](const TagSpec& other) { return other.id == tag.id; }),
             tags.end());
  tags.push_back(tag);
  ++impl_->revision;
}

void LiveWorld::remove_tag(const std::string& id) {
  const TagSpec* const tag = &impl_->tag_with(id);
  impl_->simulation.remove_tag(id);
  std::vector<TagSpec>& tags = impl_->scenario.tags;
  tags.erase(tags.begin() + (tag - tags.data()));
  ++impl_->revision;
}

void LiveWorld::move_tag(const std::string& id, const RigidTransform& X_WT) {
  require_finite(X_WT, "tag '" + id + "'");
  TagSpec& tag = impl_->tag_with(id);
  impl_->simulation.move_tag(id, X_WT);
  tag.on.clear();
  tag.motion = {{now(), X_WT}};
  ++impl_->revision;
}

void LiveWorld::detune_tag(const std::string& id, double detuning_db) {
  TagSpec& tag = impl_->tag_with(id);
  auto model = std::make_shared<TagModel>(tag.model ? *tag.model : *default_tag_model());
  model->detuning_db = detuning_db;
  Diagnostics diagnostics;
  check(*model, diagnostics);
  TagSpec detuned = tag;
  detuned.model = std::move(model);
  detuned.appears = now();
  impl_->simulation.remove_tag(id);
  impl_->simulation.add_tag(detuned);
  tag = detuned;
  ++impl_->revision;
}

std::vector<LivePose> LiveWorld::tags() const {
  std::vector<LivePose> all;
  all.reserve(impl_->scenario.tags.size());
  for (const TagSpec& tag : impl_->scenario.tags) {
    if (!impl_->simulation.has_tag(tag.id)) continue;
    all.push_back({tag.id, impl_->simulation.tag_pose(tag, now())});
  }
  return all;
}

std::vector<LivePose> LiveWorld::moving_tags() const {
  std::vector<LivePose> all;
  for (const TagSpec& tag : impl_->scenario.tags) {
    if (!moves(tag) || !impl_->simulation.has_tag(tag.id)) continue;
    all.push_back({tag.id, impl_->simulation.tag_pose(tag, now())});
  }
  return all;
}

void LiveWorld::add_antenna(const AntennaSpec& antenna) {
  const std::string& name = antenna.parameters.name;
  for (const LiveAntenna& known : impl_->antennas) {
    if (known.spec.parameters.name == name) {
      throw Error(fmt::format("there is an antenna called '{}' already", name));
    }
  }
  require_finite(antenna.X_PA, "antenna '" + name + "'");
  LiveAntenna added{antenna, false, false, impl_->port_of(antenna)};
  impl_->apply_duty(added);
  impl_->antennas.push_back(added);
  ++impl_->revision;
}

void LiveWorld::remove_antenna(const std::string& name) {
  LiveAntenna& antenna = impl_->antenna_named(name);
  impl_->switch_off(antenna);
  for (auto& [reader, duty] : impl_->duties) {
    duty.antennas.erase(std::remove_if(duty.antennas.begin(), duty.antennas.end(),
                                       [&](const AntennaDuty& one) { return one.antenna == name; }),
                        duty.antennas.end());
  }
  impl_->antennas.erase(impl_->antennas.begin() + (&antenna - impl_->antennas.data()));
  ++impl_->revision;
}

void LiveWorld::move_antenna(const std::string& name, const RigidTransform& X_WA) {
  require_finite(X_WA, "antenna '" + name + "'");
  LiveAntenna& antenna = impl_->antenna_named(name);
  impl_->switch_off(antenna);
  antenna.spec.on.clear();
  antenna.spec.X_PA = X_WA;
  antenna.spec.lift = {};
  antenna.spec.recorded.clear();
  impl_->apply_duty(antenna);
  ++impl_->revision;
}

void LiveWorld::set_antenna_faulty(const std::string& name, bool is_faulty) {
  LiveAntenna& antenna = impl_->antenna_named(name);
  if (antenna.is_faulty == is_faulty) return;
  antenna.is_faulty = is_faulty;
  impl_->apply_duty(antenna);
  ++impl_->revision;
}

const std::vector<LiveAntenna>& LiveWorld::antennas() const { return impl_->antennas; }

RigidTransform LiveWorld::antenna_pose(const LiveAntenna& antenna) const {
  return impl_->simulation.antenna_pose(antenna.spec, now());
}

std::vector<std::string> LiveWorld::readers() const {
  std::vector<std::string> all;
  for (const LiveAntenna& antenna : impl_->antennas) {
    const std::string& reader = antenna.spec.parameters.reader;
    if (std::find(all.begin(), all.end(), reader) == all.end()) all.push_back(reader);
  }
  return all;
}

std::vector<std::string> LiveWorld::set_duty(const std::string& reader, const ReaderDuty& duty) {
  impl_->require_reader(reader);
  std::vector<std::string> warnings;
  for (const AntennaDuty& one : duty.antennas) {
    const LiveAntenna& antenna = impl_->antenna_named(one.antenna);
    if (antenna.spec.parameters.reader != reader) {
      throw Error(fmt::format("antenna '{}' is not of reader '{}'", one.antenna, reader));
    }
    // Try all of them before switching the first.
    on_duty(antenna.spec.parameters, duty, warnings);
  }
  for (LiveAntenna& antenna : impl_->antennas) {
    if (antenna.spec.parameters.reader == reader) impl_->switch_off(antenna);
  }
  impl_->duties[reader] = duty;
  for (LiveAntenna* antenna : impl_->in_turn(reader)) impl_->apply_duty(*antenna);
  return warnings;
}

void LiveWorld::reset_duty(const std::string& reader) {
  impl_->require_reader(reader);
  impl_->duties.erase(reader);
  for (LiveAntenna* antenna : impl_->in_turn(reader)) impl_->apply_duty(*antenna);
}

void LiveWorld::update_reader(const std::string& reader) {
  std::vector<std::string> names;
  for (const LiveAntenna& antenna : impl_->antennas) {
    const AntennaParameters& parameters = antenna.spec.parameters;
    const bool is_on = parameters.reader == reader && antenna.is_on;
    if (is_on && takes_inventory(parameters)) names.push_back(parameters.name);
  }
  impl_->simulation.update_antennas(names);
}

std::vector<TagRead> LiveWorld::held_reads(const std::string& reader) const {
  return impl_->simulation.held_reads(reader);
}

void LiveWorld::add_obstacle(const ObstacleSpec& obstacle) {
  std::vector<ObstacleSpec>& all = impl_->scenario.obstacles;
  if (std::any_of(all.begin(), all.end(),
                  [&](const ObstacleSpec& other) { return other.name == obstacle.name; })) {
    throw Error(fmt::format("there is an obstacle called '{}' already", obstacle.name));
  }
  for (const StampedPose& pose : obstacle.motion) {
    require_finite(pose.X_WB, "obstacle '" + obstacle.name + "'");
  }
  impl_->simulation.add_obstacle(obstacle);
  all.push_back(obstacle);
  ++impl_->revision;
}

void LiveWorld::remove_obstacle(const std::string& name) {
  std::vector<ObstacleSpec>& all = impl_->scenario.obstacles;
  const auto found = std::find_if(
      all.begin(), all.end(), [&](const ObstacleSpec& obstacle) { return obstacle.name == name; });
  if (found == all.end()) throw Error(fmt::format("there is no obstacle called '{}'", name));
  impl_->simulation.remove_obstacle(name);
  all.erase(found);
  ++impl_->revision;
}

std::vector<LivePose> LiveWorld::robots() const {
  std::vector<LivePose> all;
  for (const Robot& robot : impl_->simulation.robots()) {
    all.push_back({robot.name(), robot.true_pose(impl_->scenario.time_step_s)});
  }
  return all;
}

std::vector<MovingBody> LiveWorld::bodies() const { return impl_->simulation.bodies_at(now()); }

LinkExplanation LiveWorld::explain(const std::string& antenna_name,
                                   const std::string& tag_id) const {
  const LiveAntenna& antenna = impl_->antenna_named(antenna_name);
  const TagSpec& tag = impl_->tag_with(tag_id);
  if (!antenna.is_on) {
    throw Error(fmt::format("antenna '{}' is {}", antenna_name,
                            antenna.is_faulty ? "disconnected" : "off by its reader's settings"));
  }
  const Scenario on_air = impl_->scenario_on_air();
  const Simulation& simulation = impl_->simulation;
  const auto asked =
      std::find_if(on_air.antennas.begin(), on_air.antennas.end(),
                   [&](const AntennaSpec& spec) { return spec.parameters.name == antenna_name; });
  LinkQuestion question{*asked,
                        tag,
                        now(),
                        simulation.antenna_pose(*asked, now()),
                        simulation.tag_pose(tag, now()),
                        impl_->seed,
                        simulation.bodies_at(now())};
  for (const TagSpec& other : impl_->scenario.tags) {
    if (&other == &tag || !simulation.has_tag(other.id)) continue;
    question.other_tags.push_back({other, simulation.tag_pose(other, now())});
  }
  for (const AntennaSpec& other : on_air.antennas) {
    if (&other == &*asked) continue;
    question.other_antennas.push_back({other, simulation.antenna_pose(other, now())});
  }
  return explain_link(on_air, question);
}

}  // namespace tagfield
