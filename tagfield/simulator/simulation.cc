// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/simulation.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/channel/radio_world.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/recorded_motion.h"
#include "tagfield/simulator/internal/bodies.h"
#include "tagfield/simulator/internal/mounts.h"
#include "tagfield/simulator/internal/robots.h"
#include "tagfield/simulator/internal/tag_schedule.h"
#include "tagfield/simulator/robot.h"

namespace tagfield {
namespace {

std::optional<Time> end_of(const Scenario& scenario, bool is_remote) {
  if (scenario.duration_s) return time_from_seconds(*scenario.duration_s);
  if (const auto last = end_of_recordings(scenario.antennas)) return *last + Duration(1);
  if (is_remote || std::any_of(scenario.robots.begin(), scenario.robots.end(), drives)) {
    return std::nullopt;
  }
  throw Error("duration_s must be given where no robot has waypoints to drive");
}

}  // namespace

std::shared_ptr<const RadioWorld> radio_world_of(const Scenario& scenario) {
  if (scenario.radio_world) return scenario.radio_world;
  Diagnostics nothing_to_say;
  return std::make_shared<const RadioWorld>(radio_world(Scene{}, {}, nothing_to_say));
}

Simulation::Simulation(const Scenario& scenario, std::uint64_t seed, Outlets outlets,
                       const SelfDriving* driving, const RemoteDriving* remote, int threads)
    : seed_(seed),
      time_step_(duration_from_seconds(scenario.time_step_s)),
      end_(end_of(scenario, remote != nullptr)),
      robots_(robots_of(scenario, seed, driving, remote)),
      schedule_(std::make_unique<TagSchedule>(scenario.tags)),
      field_(std::move(outlets), scenario.radio_world, threads) {
  if (time_step_ <= Duration::zero()) throw Error("time_step_s must be greater than 0");
  for (const RobotSpec& robot : scenario.robots) {
    if (robot.body) robot_bodies_.emplace_back(robot.name, *robot.body);
  }
  for (const ObstacleSpec& obstacle : scenario.obstacles) {
    if (obstacle.body) obstacles_.push_back(obstacle);
  }
  for (const AntennaSpec& antenna : scenario.antennas) add_antenna(antenna);
  for (const TagSpec& tag : scenario.tags) require_robot(robots_, tag.on, tag.location);
  handle_events(Time{});
}

Simulation::~Simulation() = default;
Simulation::Simulation(Simulation&&) noexcept = default;
Simulation& Simulation::operator=(Simulation&&) noexcept = default;

bool Simulation::finished() const {
  if (end_) return now_ >= *end_;
  return std::all_of(robots_.begin(), robots_.end(),
                     [](const Robot& robot) { return robot.finished(); });
}

double Simulation::progress() const {
  if (end_) return std::clamp(to_seconds(now_) / std::max(to_seconds(*end_), 1e-9), 0.0, 1.0);
  return progress_of(robots_);
}

double Simulation::travelled_m() const { return travelled_by(robots_); }

void Simulation::add_tag(const TagSpec& tag) {
  require_robot(robots_, tag.on, tag.location);
  if (tag.motion.empty()) fail(tag.location, fmt::format("tag '{}' has no position", tag.id));
  require_rising_stamps(tag.motion);
  try {
    const std::uint32_t number = driver_.add_tag(tag.id, "", tag.model);
    driver_.place_tag(number, tag.motion.front().X_WB, std::max(tag.appears, Time{}));
    tags_[tag.id] = number;
    if (!moves(tag)) return;
    const auto after = std::find_if(moving_tags_.begin(), moving_tags_.end(),
                                    [&](const auto& other) { return other.first > number; });
    moving_tags_.emplace(after, number, tag);
  } catch (const Error& error) {
    fail(tag.location, error.what());
  }
}

void Simulation::remove_tag(const std::string& id) {
  const auto found = tags_.find(id);
  if (found == tags_.end()) throw Error(fmt::format("there is no tag with the ID '{}'", id));
  const std::uint32_t number = found->second;
  tags_.erase(found);
  driver_.remove_tag(number);
  hold_tag(number);
}

/// The tag no longer moves by itself.
void Simulation::hold_tag(std::uint32_t number) {
  std::erase_if(moving_tags_, [&](const auto& tag) { return tag.first == number; });
}

void Simulation::move_tag(const std::string& id, const RigidTransform& X_WT) {
  const auto found = tags_.find(id);
  if (found == tags_.end()) throw Error(fmt::format("there is no tag with the ID '{}'", id));
  hold_tag(found->second);
  driver_.place_tag(found->second, X_WT, now_);
}

void Simulation::add_antenna(const AntennaSpec& antenna) {
  const std::string& name = antenna.parameters.name;
  require_robot(robots_, antenna.on, antenna.location);
  auto added = std::make_shared<FieldAntenna>();
  added->parameters = antenna.parameters;
  added->seed = seed_;
  added->frame_id = name;
  added->is_fixed = is_fixed(antenna);
  if (driver_.has_antenna(name)) {
    fail(antenna.location, fmt::format("there is an antenna called '{}' already", name));
  }
  try {
    check(antenna.parameters);
  } catch (const Error& error) {
    fail(antenna.location, fmt::format("antenna '{}': {}", name, error.what()));
  }
  driver_.add_antenna(added);
  driver_.start(added, now_, stamps_of(antenna.recorded));
  antennas_[name] = antenna;
}

void Simulation::remove_antenna(const std::string& name) {
  if (antennas_.erase(name) == 0) {
    throw Error(fmt::format("there is no antenna called '{}'", name));
  }
  driver_.remove_antenna(name);
}

void Simulation::update_antenna(const std::string& name) { update_antennas({name}); }

void Simulation::update_antennas(const std::vector<std::string>& names) {
  std::vector<AntennaDue> due;
  for (const std::string& name : names) {
    if (antennas_.count(name) == 0) {
      throw Error(fmt::format("there is no antenna called '{}'", name));
    }
    due.emplace_back();
    due.back().antenna = driver_.antenna(name);
  }
  if (!due.empty()) update(std::move(due), last_instant());
}

void Simulation::add_obstacle(const ObstacleSpec& obstacle) {
  if (obstacle.body) obstacles_.push_back(obstacle);
}

void Simulation::remove_obstacle(const std::string& name) {
  std::erase_if(obstacles_, [&](const ObstacleSpec& obstacle) { return obstacle.name == name; });
}

void Simulation::begin_step() {
  step_begin_ = now_;
  now_ += time_step_;
  for (Robot& robot : robots_) robot.step(step_begin_, to_seconds(time_step_));
}

void Simulation::skip_step() {
  begin_step();
  driver_.go_on(now_);
  handle_events(now_ - Duration(1));
}

void Simulation::step() {
  begin_step();
  while (const std::optional<Time> due = driver_.next_due()) {
    if (*due >= now_) break;
    update_at(*due);
  }
  handle_events(now_ - Duration(1));
  if (!finished()) return;
  read_to_the_end();
  finish();
}

/// Inventories have gone on since their antennas' last updates.
void Simulation::read_to_the_end() {
  std::vector<AntennaDue> due;
  for (const auto& [name, antenna] : antennas_) {
    const RadioModel* const model = physical(antenna.parameters);
    if (model == nullptr || !takes_inventory(*model) || !antenna.recorded.empty()) continue;
    due.emplace_back();
    due.back().antenna = driver_.antenna(name);
  }
  std::sort(due.begin(), due.end(), [](const AntennaDue& a, const AntennaDue& b) {
    return a.antenna->parameters.name < b.antenna->parameters.name;
  });
  if (!due.empty()) update(std::move(due), last_instant());
}

/// Of the last step, since now_ belongs to the next one.
Time Simulation::last_instant() const { return std::max(Time{}, now_ - Duration(1)); }

/// Lets tags that are due by `until` appear and disappear.
void Simulation::handle_events(Time until) {
  while (const auto tag = schedule_->next_to_appear(until)) add_tag(*tag);
  while (const auto id = schedule_->next_to_disappear(until)) {
    // The caller may have removed the tag already.
    if (tags_.count(*id) > 0) remove_tag(*id);
  }
}

double Simulation::seconds_into_step(Time stamp) const { return to_seconds(stamp - step_begin_); }

RigidTransform Simulation::tag_pose(const TagSpec& tag, Time stamp) const {
  RigidTransform X_PT =
      tag.in_steps ? row_at(tag.motion, stamp).X_WB : held_pose_at(tag.motion, stamp);
  if (tag.on.empty()) return X_PT;
  return robot_named(robots_, tag.on)->true_pose(seconds_into_step(stamp)) * X_PT;
}

RigidTransform Simulation::antenna_pose(const AntennaSpec& antenna, Time stamp) const {
  if (!antenna.recorded.empty()) return row_at(antenna.recorded, stamp).X_WB;
  RigidTransform X_PA = mount_at(antenna, stamp);
  if (antenna.on.empty()) return X_PA;
  return robot_named(robots_, antenna.on)->true_pose(seconds_into_step(stamp)) * X_PA;
}

std::vector<MovingBody> Simulation::bodies_at(Time stamp) const {
  std::vector<MovingBody> bodies;
  for (const auto& [name, body] : robot_bodies_) {
    bodies.push_back(
        body_of(name, body, robot_named(robots_, name)->true_pose(seconds_into_step(stamp))));
  }
  const std::vector<MovingBody> others = bodies_of(obstacles_, stamp);
  bodies.insert(bodies.end(), others.begin(), others.end());
  return bodies;
}

/// Sets the antenna's true pose, and the pose believed by its robot.
void Simulation::place(AntennaDue& due, Time stamp) const {
  const AntennaSpec& antenna = antennas_.at(due.antenna->parameters.name);
  due.X_WA = antenna_pose(antenna, stamp);
  due.X_PA = due.X_WA;
  if (!antenna.recorded.empty() || antenna.on.empty()) return;
  const Robot& robot = *robot_named(robots_, antenna.on);
  due.X_PA = robot.believed_pose(seconds_into_step(stamp)) * mount_at(antenna, stamp);
}

/// Updates all antennas due at `stamp`, with everything that moves at its pose then.
void Simulation::update_at(Time stamp) {
  handle_events(stamp);
  update(driver_.take_due(stamp), stamp);
}

void Simulation::update(std::vector<AntennaDue> due, Time stamp) {
  for (const auto& [number, tag] : moving_tags_) {
    driver_.place_tag(number, tag_pose(tag, stamp), stamp);
  }
  for (AntennaDue& antenna : due) place(antenna, stamp);
  FieldStep step = driver_.take_step(stamp);
  step.due = std::move(due);
  if (!robot_bodies_.empty() || !obstacles_.empty()) {
    step.bodies = std::make_shared<const std::vector<MovingBody>>(bodies_at(stamp));
  }
  const double seconds = seconds_into_step(stamp);
  for (const Robot& robot : robots_) {
    step.robots.push_back({stamp, robot.name(), robot.true_pose(seconds)});
  }
  field_.step(step);
}

}  // namespace tagfield
