// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_classic/rfid_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>
#include <utility>

#include "adapters/gazebo_classic/conversions.h"
#include "adapters/gazebo_common/sensor_names.h"
#include "tagfield/base/error.h"
#include "tagfield/field/antenna_facts.h"

namespace tagfield {
namespace {

constexpr const char* kWorldFrame = "world";
/// Simulated time for which a fault is tolerated, as it may be temporary.
constexpr Duration kPatience = std::chrono::milliseconds(200);

}  // namespace

RfidWorld::RfidWorld(const gazebo::physics::WorldPtr& world, Outlets outlets,
                     std::function<void(Time)> on_step)
    : world_(world),
      solids_(world),
      on_step_(std::move(on_step)),
      worker_(std::move(outlets),
              {[](const std::string& warning) { gzwarn << "Tagfield: " << warning << "\n"; },
               [](const std::string& error) { gzerr << "Tagfield: " << error << "\n"; }}),
      connection_(gazebo::event::Events::ConnectWorldUpdateEnd([this] { after_step(); })) {}

RfidWorld::~RfidWorld() { connection_.reset(); }

RfidWorld::Handle RfidWorld::add_tags(TagsOnLink tags) {
  const std::lock_guard lock(mutex_);
  TagGroup group;
  group.handle = next_handle_++;
  group.on_link = std::move(tags);
  groups_.push_back(std::move(group));
  all_found_ = false;
  return groups_.back().handle;
}

void RfidWorld::remove_tags(Handle handle) {
  const std::lock_guard lock(mutex_);
  const auto found =
      std::lower_bound(groups_.begin(), groups_.end(), handle,
                       [](const TagGroup& group, Handle sought) { return group.handle < sought; });
  if (found == groups_.end() || found->handle != handle) return;
  for (const std::uint32_t number : found->numbers) driver_.remove_tag(number);
  groups_.erase(found);
}

RfidWorld::Handle RfidWorld::add_antenna(AntennaOnLink antenna) {
  const std::lock_guard lock(mutex_);
  const std::string& name = antenna.antenna.parameters.name;
  if (driver_.has_antenna(name) && name == antenna.antenna.sensor) {
    put_model_in_front(antenna.model, antenna.antenna);
  }
  if (driver_.has_antenna(name)) {
    throw Error(fmt::format(
        "there is an antenna called '{}' already; give this one another <antenna>", name));
  }
  driver_.add_antenna(std::make_shared<const FieldAntenna>(antenna.antenna));
  // Immediately, so that its topics can be subscribed to while the world is paused.
  worker_.post(driver_.take_step(std::max(last_, Time{})));
  Antenna entry;
  entry.on_link = std::move(antenna);
  antennas_.emplace(next_handle_, std::move(entry));
  all_found_ = false;
  return next_handle_++;
}

void RfidWorld::remove_antenna(Handle handle) {
  const std::lock_guard lock(mutex_);
  const auto found = antennas_.find(handle);
  if (found == antennas_.end()) return;
  driver_.remove_antenna(found->second.on_link.antenna.parameters.name);
  antennas_.erase(found);
}

void RfidWorld::set_materials(RadioWorldOptions materials) {
  const std::lock_guard lock(mutex_);
  if (materials_) throw Error("another plugin already states the world's materials");
  materials_ = std::move(materials);
  solids_.forget();
}

FieldCost RfidWorld::cost() const {
  const std::lock_guard lock(mutex_);
  FieldCost cost = cost_;
  const WorkDone done = worker_.done();
  cost.reads_s = done.busy_s;
  cost.reads = done.reads;
  return cost;
}

void RfidWorld::describe(TagGroup& group) {
  std::vector<TagOnLink> tags = group.on_link.describe(*group.link);
  try {
    for (const TagOnLink& tag : tags) {
      group.numbers.push_back(driver_.add_tag(tag.id, tag.label, tag.model));
    }
  } catch (const Error&) {
    for (const std::uint32_t number : group.numbers) driver_.remove_tag(number);
    group.numbers.clear();
    throw;
  }
  group.tags = std::move(tags);
}

void RfidWorld::set_up(Antenna& antenna, Time now) {
  FieldAntenna field = antenna.on_link.antenna;
  field.is_fixed = antenna.link->IsStatic();
  // The pose of a permanently mounted antenna is known.
  if (field.parent_frame.empty() && field.is_fixed) field.parent_frame = kWorldFrame;
  if (!field.parent_frame.empty() && field.parent_frame != kWorldFrame) {
    const gazebo::physics::ModelPtr model = antenna.link->GetModel();
    antenna.parent = model->GetLink(field.parent_frame);
    if (!antenna.parent) {
      throw Error(fmt::format("<parent_frame> is '{}', expected a link of model '{}'",
                              field.parent_frame, model->GetName()));
    }
  }
  driver_.start(std::make_shared<const FieldAntenna>(field), now);
}

template <class Entry, class SetUp>
void RfidWorld::find_link(Entry& entry, Time now, const SetUp& set_up, const char* consequence) {
  if (entry.link || entry.refused) return;
  entry.link =
      boost::dynamic_pointer_cast<gazebo::physics::Link>(world_->EntityByName(entry.on_link.link));
  all_found_ = all_found_ && entry.link;
  if (!entry.link) return;
  try {
    set_up();
  } catch (const std::exception& error) {
    entry.link.reset();
    // A deleted tag may still hold its ID for a moment when its successor appears.
    if (!entry.faulty_since) entry.faulty_since = now;
    entry.refused = now - *entry.faulty_since >= kPatience || now < *entry.faulty_since;
    all_found_ = all_found_ && entry.refused;
    if (entry.refused) {
      gzerr << entry.on_link.place << ": " << error.what() << "; " << consequence << "\n";
    }
  }
}

/// Finds the links of tags and antennas added since the last step. Between two steps all models are
/// complete; a missing link was removed again, and its plugin will be unloaded too.
void RfidWorld::find_links(Time now) {
  if (all_found_) return;
  all_found_ = true;
  for (TagGroup& group : groups_)
    find_link(
        group, now, [&] { describe(group); }, "left out");
  for (auto& [handle, antenna] : antennas_) {
    Antenna& entry = antenna;
    find_link(
        entry, now, [&] { set_up(entry, now); }, "stays off");
  }
}

void RfidWorld::after_step() {
  const Time time = from_gazebo(world_->SimTime());
  on_step_(time);
  const std::lock_guard lock(mutex_);
  find_links(last_ == Time::min() ? Time{} : time);
  if (time < last_) driver_.go_on(time);  // The world was reset.
  last_ = time;
  const std::optional<Time> due = driver_.next_due();
  if (!driver_.has_news() && !(due && *due <= time)) return;
  const auto begin = std::chrono::steady_clock::now();
  FieldStep step = gather(time);
  if (step.added.empty()) {
    cost_.updates += static_cast<std::int64_t>(step.due.size());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    cost_.physics_s += took.count();
  }
  // Not included above: if this blocks, it waits for the reads, which are counted separately.
  // Posted with the lock held: an antenna that is added concurrently must not overtake this step
  // with later changes.
  worker_.post(std::move(step));
}

FieldStep RfidWorld::gather(Time now) {
  place_tags(now);
  std::vector<AntennaDue> due = driver_.take_due(now);
  for (AntennaDue& antenna : due) place(antenna);
  FieldStep step = driver_.take_step(now);
  step.due = std::move(due);
  gather_world(step);
  return step;
}

/// The static world is copied here; the worker prepares it for wave propagation.
void RfidWorld::gather_world(FieldStep& step) {
  const bool is_of_use = std::any_of(step.due.begin(), step.due.end(), [](const AntennaDue& due) {
    return meets_world(due.antenna->parameters);
  });
  if (!is_of_use || !solids_.has_changed()) return;
  step.world = std::make_shared<const FieldWorld>(
      FieldWorld{solids_.gather(), materials_.value_or(RadioWorldOptions{})});
}

void RfidWorld::place_tags(Time now) {
  for (TagGroup& group : groups_) {
    if (!group.link) continue;
    const ignition::math::Pose3d& pose = group.link->WorldPose();
    if ((group.placed && is_same(pose, group.X_WL)) || !pose.IsFinite()) continue;
    group.X_WL = pose;
    group.placed = true;
    const RigidTransform X_WL = from_gazebo(pose);
    for (std::size_t i = 0; i < group.tags.size(); ++i) {
      driver_.place_tag(group.numbers[i], X_WL * group.tags[i].X_LT, now);
    }
  }
}

void RfidWorld::place(AntennaDue& due) const {
  const std::string& name = due.antenna->parameters.name;
  const auto found = std::find_if(antennas_.begin(), antennas_.end(), [&](const auto& entry) {
    return entry.second.on_link.antenna.parameters.name == name;
  });
  const Antenna& antenna = found->second;
  due.X_WA = from_gazebo(antenna.link->WorldPose()) * antenna.on_link.X_LA;
  if (due.antenna->parent_frame.empty()) return;
  due.X_PA =
      antenna.parent ? from_gazebo(antenna.parent->WorldPose()).inverse() * due.X_WA : due.X_WA;
}

}  // namespace tagfield
