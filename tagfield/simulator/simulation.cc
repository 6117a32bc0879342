#include "tagfield/simulator/simulation.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/random.h"
#include "tagfield/scenario/recorded_motion.h"
#include "tagfield/simulator/self_driver.h"

namespace tagfield {
namespace {

constexpr double kLeastCell = 0.5;
constexpr double kMostCell = 1e6;

/// Half of the longest range: a query then visits some 30 columns.
double cell_size(const Scenario& scenario) {
  double longest = 0.0;
  for (const AntennaSpec& antenna : scenario.antennas) {
    longest = std::max(longest, antenna.parameters.range_m);
  }
  return std::clamp(longest / 2.0, kLeastCell, kMostCell);
}

bool is_fixed(const AntennaSpec& antenna) {
  return antenna.on.empty() && !(antenna.lift.travel_m > 0.0) && antenna.recorded.empty();
}

/// The row that holds at `stamp`; the first one before them all.
const StampedPose& row_at(const Trajectory& rows, Time stamp) {
  const auto after = std::upper_bound(rows.begin(), rows.end(), stamp,
                                      [](Time t, const StampedPose& row) { return t < row.stamp; });
  return after == rows.begin() ? *after : *std::prev(after);
}

/// X_PA at `stamp`, the lift's height included.
RigidTransform mount_at(const AntennaSpec& antenna, Time stamp) {
  return from_translation({0.0, 0.0, lift_height(antenna.lift, stamp)}) * antenna.X_PA;
}

std::optional<Time> end_of(const Scenario& scenario) {
  if (scenario.duration_s) return time_from_seconds(*scenario.duration_s);
  if (const auto last = end_of_recordings(scenario.antennas)) return *last + Duration(1);
  if (std::any_of(scenario.robots.begin(), scenario.robots.end(), drives)) return std::nullopt;
  throw Error("duration_s must be given where no robot has waypoints to drive");
}

/// What a place is drawn for.
enum class PlaceDraw : std::uint64_t { kStart, kGoal, kCarried };

/// A robot that knows about where it is put.
constexpr double kPlacedSigma_m = 0.02;
constexpr double kPlacedSigma_rad = 0.01;

/// A place that is drawn for this robot at this seed; `what` tells its draws apart.
PlanarPose drawn_place(const NavigationWorld& world, const RobotSpec& robot, std::uint64_t seed,
                       PlaceDraw what, std::uint64_t number) {
  RandomStream stream(seed, Purpose::kPlaces, stream_key(robot.name),
                      static_cast<std::uint64_t>(what), number);
  return random_place(world.floor, stream);
}

std::vector<PlanarPose> goals_of(const NavigationWorld& world, const RobotSpec& robot,
                                 std::uint64_t seed) {
  if (!robot.waypoints.empty()) return goals_at(robot.start, robot.waypoints);
  std::vector<PlanarPose> goals = robot.goals_W;
  for (int i = 0; i < robot.random_goals; ++i) {
    goals.push_back(
        drawn_place(world, robot, seed, PlaceDraw::kGoal, static_cast<std::uint64_t>(i)));
  }
  return goals;
}

Robot self_driving_robot(const Scenario& scenario, RobotSpec robot, const SelfDriving& driving,
                         bool has_mapped, std::uint64_t seed) {
  const NavigationWorld& world = *driving.world;
  const std::vector<PlanarPose> goals = goals_of(world, robot, seed);
  std::optional<PoseEstimate> start = has_mapped ? driving.start : placed_at(robot.start);
  if (has_mapped) robot.start = driving.true_start;
  if (scenario.navigation.start != StartBelief::kKnown) start.reset();
  if (scenario.navigation.start == StartBelief::kRandom) {
    robot.start = drawn_place(world, robot, seed, PlaceDraw::kStart, 0);
  }
  for (std::size_t i = 0; i < robot.carried.size(); ++i) {
    std::optional<PlanarPose>& to_W = robot.carried[i].to_W;
    if (!to_W) to_W = drawn_place(world, robot, seed, PlaceDraw::kCarried, i);
  }
  auto driver =
      std::make_unique<SelfDriver>(scenario.navigation, robot.style.speed_m_s, world, *driving.map,
                                   start, goals, seed, stream_key(robot.name));
  return {robot, std::move(driver), seed};
}

}  // namespace

std::shared_ptr<const RadioWorld> radio_world_of(const Scenario& scenario) {
  if (scenario.radio_world) return scenario.radio_world;
  Diagnostics nothing_to_say;
  return std::make_shared<const RadioWorld>(radio_world(Scene{}, {}, nothing_to_say));
}

PoseEstimate placed_at(const PlanarPose& pose) {
  return {pose, Eigen::Vector3d(kPlacedSigma_m * kPlacedSigma_m, kPlacedSigma_m * kPlacedSigma_m,
                                kPlacedSigma_rad * kPlacedSigma_rad)
                    .asDiagonal()};
}

Simulation::Simulation(const Scenario& scenario, std::uint64_t seed)
    : Simulation(scenario, nullptr, seed) {}

Simulation::Simulation(const Scenario& scenario, const SelfDriving& driving, std::uint64_t seed)
    : Simulation(scenario, &driving, seed) {}

Simulation::Simulation(const Scenario& scenario, const SelfDriving* driving, std::uint64_t seed)
    : seed_(seed),
      time_step_(duration_from_seconds(scenario.time_step_s)),
      end_(end_of(scenario)),
      tags_(cell_size(scenario)),
      air_(radio_world_of(scenario), seed) {
  if (time_step_ <= Duration::zero()) throw Error("time_step_s must be greater than 0");
  bool has_mapped = true;
  for (const RobotSpec& robot : scenario.robots) {
    if (robot_named(robot.name) != nullptr) {
      fail(robot.location, fmt::format("a second robot is called '{}'", robot.name));
    }
    if (driving != nullptr && drives(robot)) {
      robots_.push_back(self_driving_robot(scenario, robot, *driving, has_mapped, seed_));
      has_mapped = false;
    } else {
      robots_.emplace_back(robot, scenario.pose, seed_);
    }
  }
  for (const AntennaSpec& antenna : scenario.antennas) add_antenna(antenna);
  plan_appearances(scenario.tags);
}

/// Sorts what is to come so that the next to appear or disappear stands last.
void Simulation::plan_appearances(const std::vector<TagSpec>& tags) {
  std::unordered_map<std::string, Location> seen;
  for (const TagSpec& tag : tags) {
    const auto [first, is_new] = seen.emplace(tag.id, tag.location);
    if (!is_new) {
      fail(tag.location, fmt::format("a second tag has the ID '{}' (the first: {})", tag.id,
                                     to_string(first->second)));
    }
    require_robot(tag.on, tag.location);
    if (tag.disappears) to_disappear_.emplace_back(*tag.disappears, tag.id);
  }
  to_appear_ = tags;
  // The list is used from its end, so tags of one time are added in the scenario's order.
  std::reverse(to_appear_.begin(), to_appear_.end());
  std::stable_sort(to_appear_.begin(), to_appear_.end(),
                   [](const TagSpec& a, const TagSpec& b) { return a.appears > b.appears; });
  std::stable_sort(to_disappear_.begin(), to_disappear_.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  handle_events(Time{});
}

const Robot* Simulation::robot_named(const std::string& name) const {
  const auto found = std::find_if(robots_.begin(), robots_.end(),
                                  [&](const Robot& robot) { return robot.name() == name; });
  return found == robots_.end() ? nullptr : &*found;
}

void Simulation::require_robot(const std::string& name, const Location& location) const {
  if (!name.empty() && robot_named(name) == nullptr) {
    fail(location, fmt::format("there is no robot '{}' to be on", name));
  }
}

bool Simulation::finished() const {
  if (end_) return now_ >= *end_;
  return std::all_of(robots_.begin(), robots_.end(),
                     [](const Robot& robot) { return robot.finished(); });
}

double Simulation::progress() const {
  if (end_) return std::clamp(to_seconds(now_) / std::max(to_seconds(*end_), 1e-9), 0.0, 1.0);
  double slowest = 1.0;
  for (const Robot& robot : robots_) slowest = std::min(slowest, robot.progress());
  return slowest;
}

double Simulation::travelled_m() const {
  double travelled = 0.0;
  for (const Robot& robot : robots_) travelled += robot.travelled_m();
  return travelled;
}

std::uint32_t Simulation::place_new(const TagSpec& tag) {
  try {
    const std::uint32_t slot = tags_.add(tag.id, tag.motion.front().X_WB.translation);
    if (slot >= specs_.size()) specs_.resize(slot + std::size_t{1});
    specs_[slot] = tag;
    tags_.turn(slot, tag.motion.front().X_WB.rotation);
    if (tag.model) tags_.set_model(slot, tag.model);
    return slot;
  } catch (const Error& error) {
    fail(tag.location, error.what());
  }
}

void Simulation::add_tag(const TagSpec& tag) {
  require_robot(tag.on, tag.location);
  if (tag.motion.empty()) fail(tag.location, fmt::format("tag '{}' has no position", tag.id));
  require_rising_stamps(tag.motion);
  const std::uint32_t slot = place_new(tag);
  std::vector<std::uint32_t>& list = moves(tag) ? moving_slots_ : new_slots_;
  list.insert(std::upper_bound(list.begin(), list.end(), slot), slot);
  moved_to_ = Time::min();
}

void Simulation::remove_tag(const std::string& id) {
  const std::optional<std::uint32_t> found = tags_.find(id);
  if (!found) throw Error(fmt::format("there is no tag with the ID '{}'", id));
  const std::uint32_t slot = *found;
  air_.forget_tag(slot);
  tags_.remove(slot);
  for (std::vector<std::uint32_t>* list : {&moving_slots_, &new_slots_}) {
    list->erase(std::remove(list->begin(), list->end(), slot), list->end());
  }
}

void Simulation::add_antenna(const AntennaSpec& antenna) {
  const std::string& name = antenna.parameters.name;
  for (const AntennaSpec& other : antennas_) {
    if (other.parameters.name == name) {
      fail(antenna.location, fmt::format("there is an antenna called '{}' already", name));
    }
  }
  require_robot(antenna.on, antenna.location);
  try {
    check(antenna.parameters);
  } catch (const Error& error) {
    fail(antenna.location, fmt::format("antenna '{}': {}", name, error.what()));
  }
  antennas_.push_back(antenna);
  if (antenna.parameters.radio) air_.add(antenna.parameters);
}

void Simulation::remove_antenna(const std::string& name) {
  const auto found =
      std::find_if(antennas_.begin(), antennas_.end(),
                   [&](const AntennaSpec& antenna) { return antenna.parameters.name == name; });
  if (found == antennas_.end()) throw Error(fmt::format("there is no antenna called '{}'", name));
  antennas_.erase(found);
  air_.remove(name);
  recorded_fixed_.erase(std::remove(recorded_fixed_.begin(), recorded_fixed_.end(), name),
                        recorded_fixed_.end());
}

void Simulation::begin_step() {
  step_begin_ = now_;
  now_ += time_step_;
  for (Robot& robot : robots_) robot.step(step_begin_, to_seconds(time_step_));
}

void Simulation::skip_step() {
  begin_step();
  handle_events(now_ - Duration(1));
}

void Simulation::step(Recording& recording) {
  begin_step();
  for (const Update& update : updates_in_step()) {
    handle_events(update.stamp);
    record_new_tags(recording);
    move_tags(update.stamp, recording);
    update_antenna(update, recording);
  }
  handle_events(now_ - Duration(1));
}

std::vector<Time> Simulation::stamps_in_step(const AntennaSpec& antenna) const {
  std::vector<Time> stamps;
  if (!antenna.recorded.empty()) {
    auto row = std::lower_bound(antenna.recorded.begin(), antenna.recorded.end(), step_begin_,
                                [](const StampedPose& a, Time t) { return a.stamp < t; });
    for (; row != antenna.recorded.end() && row->stamp < now_; ++row) stamps.push_back(row->stamp);
    return stamps;
  }
  std::int64_t number = first_update_at(antenna.parameters, step_begin_);
  for (Time stamp = update_stamp(antenna.parameters, number); stamp < now_;
       stamp = update_stamp(antenna.parameters, ++number)) {
    stamps.push_back(stamp);
  }
  return stamps;
}

std::vector<Simulation::Update> Simulation::updates_in_step() const {
  std::vector<Update> updates;
  for (std::size_t i = 0; i < antennas_.size(); ++i) {
    for (const Time stamp : stamps_in_step(antennas_[i])) updates.push_back({stamp, i});
  }
  std::stable_sort(updates.begin(), updates.end(),
                   [](const Update& a, const Update& b) { return a.stamp < b.stamp; });
  return updates;
}

/// Lets tags appear and disappear that are due by `until`.
void Simulation::handle_events(Time until) {
  while (!to_appear_.empty() && to_appear_.back().appears <= until) {
    add_tag(to_appear_.back());
    to_appear_.pop_back();
  }
  while (!to_disappear_.empty() && to_disappear_.back().first <= until) {
    // Whoever uses this class may have removed the tag already.
    if (tags_.find(to_disappear_.back().second)) remove_tag(to_disappear_.back().second);
    to_disappear_.pop_back();
  }
}

double Simulation::seconds_into_step(Time stamp) const { return to_seconds(stamp - step_begin_); }

RigidTransform Simulation::tag_pose(const TagSpec& tag, Time stamp) const {
  RigidTransform X_PT =
      tag.in_steps ? row_at(tag.motion, stamp).X_WB : held_pose_at(tag.motion, stamp);
  if (tag.on.empty()) return X_PT;
  return robot_named(tag.on)->true_pose(seconds_into_step(stamp)) * X_PT;
}

RigidTransform Simulation::antenna_pose(const AntennaSpec& antenna, Time stamp) const {
  if (!antenna.recorded.empty()) return row_at(antenna.recorded, stamp).X_WB;
  RigidTransform X_PA = mount_at(antenna, stamp);
  if (antenna.on.empty()) return X_PA;
  return robot_named(antenna.on)->true_pose(seconds_into_step(stamp)) * X_PA;
}

void Simulation::record_new_tags(Recording& recording) {
  for (const std::uint32_t slot : new_slots_) {
    const TagSpec& tag = specs_[slot];
    recording.truth.tag_positions.push_back(
        {std::max(tag.appears, Time{}), tag.id, tags_.position(slot)});
  }
  new_slots_.clear();
}

/// Moves all that can move to `stamp`, once for all antennas that update then.
void Simulation::move_tags(Time stamp, Recording& recording) {
  if (stamp == moved_to_) return;
  moved_to_ = stamp;
  for (const std::uint32_t slot : moving_slots_) {
    const TagSpec& tag = specs_[slot];
    const RigidTransform X_WT = tag_pose(tag, stamp);
    tags_.move(slot, X_WT.translation);
    tags_.turn(slot, X_WT.rotation);
    recording.truth.tag_positions.push_back({stamp, tag.id, tags_.position(slot)});
  }
  const double seconds = seconds_into_step(stamp);
  for (const Robot& robot : robots_) {
    recording.truth.robot_poses.push_back({stamp, robot.name(), robot.true_pose(seconds)});
  }
}

RigidTransform Simulation::place_antenna(const AntennaSpec& antenna, Time stamp,
                                         Recording& recording) {
  const std::string& name = antenna.parameters.name;
  RigidTransform X_WA = antenna_pose(antenna, stamp);
  RigidTransform believed = X_WA;
  if (is_fixed(antenna)) {
    if (std::find(recorded_fixed_.begin(), recorded_fixed_.end(), name) != recorded_fixed_.end()) {
      return X_WA;
    }
    recorded_fixed_.push_back(name);
  } else if (antenna.recorded.empty() && !antenna.on.empty()) {
    const Robot& robot = *robot_named(antenna.on);
    believed = robot.believed_pose(seconds_into_step(stamp)) * mount_at(antenna, stamp);
  }
  recording.believed_poses.push_back({stamp, name, believed});
  recording.truth.antenna_poses.push_back({stamp, name, X_WA});
  return X_WA;
}

void Simulation::update_antenna(const Update& update, Recording& recording) {
  const AntennaSpec& antenna = antennas_[update.antenna];
  const RigidTransform X_WA = place_antenna(antenna, update.stamp, recording);
  if (antenna.parameters.radio) {
    air_.update(antenna.parameters.name, X_WA, update.stamp, tags_, replies_);
  } else {
    read_tags(antenna.parameters, X_WA.translation, update.stamp, seed_, tags_, replies_);
  }
  for (const TagReply& reply : replies_) {
    const std::string& id = tags_.id(reply.slot);
    recording.reads.push_back(to_read(antenna.parameters, id, reply));
    recording.truth.distances.push_back(
        {reply.stamp, antenna.parameters.name, id, reply.distance_m});
  }
}

}  // namespace tagfield
