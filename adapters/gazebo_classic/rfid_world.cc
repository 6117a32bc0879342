#include "adapters/gazebo_classic/rfid_world.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <gazebo/common/Console.hh>
#include <gazebo/physics/physics.hh>
#include <utility>

#include "adapters/gazebo_classic/conversions.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr const char* kWorldFrame = "world";
/// Simulated time in which a fault may pass.
constexpr Duration kPatience = std::chrono::milliseconds(200);

}  // namespace

RfidWorld::RfidWorld(const gazebo::physics::WorldPtr& world,
                     std::vector<std::unique_ptr<FieldListener>> listeners,
                     std::function<void(Time)> on_step)
    : world_(world),
      solids_(world),
      on_step_(std::move(on_step)),
      worker_(std::move(listeners)),
      connection_(gazebo::event::Events::ConnectWorldUpdateEnd([this] { after_step(); })) {}

RfidWorld::~RfidWorld() { connection_.reset(); }

std::uint32_t RfidWorld::free_number() {
  if (free_numbers_.empty()) return next_number_++;
  const std::uint32_t number = free_numbers_.back();
  free_numbers_.pop_back();
  return number;
}

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
  const TagGroup& group = *found;
  for (const TagOnLink& tag : group.tags) ids_.erase(tag.id);
  // Within a step the field takes tags out before it puts others in, so a number is free at once.
  if (group.told) removed_.insert(removed_.end(), group.numbers.begin(), group.numbers.end());
  free_numbers_.insert(free_numbers_.end(), group.numbers.begin(), group.numbers.end());
  groups_.erase(found);
}

bool RfidWorld::has_antenna(const std::string& name) const {
  const std::lock_guard lock(mutex_);
  return std::any_of(antennas_.begin(), antennas_.end(), [&](const auto& entry) {
    return entry.second.on_link.antenna.parameters.name == name;
  });
}

RfidWorld::Handle RfidWorld::add_antenna(AntennaOnLink antenna) {
  const std::string name = antenna.antenna.parameters.name;
  if (has_antenna(name)) {
    throw Error(
        fmt::format("there is an antenna called '{}' already; give this one another "
                    "<antenna>",
                    name));
  }
  const std::lock_guard lock(mutex_);
  // At once, so that its topics can be subscribed to while the world is paused.
  FieldStep step;
  step.antennas_removed.swap(antennas_removed_);  // One of them may have had the name.
  step.antennas_added = {std::make_shared<const FieldAntenna>(antenna.antenna)};
  worker_.post(std::move(step));
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
  antennas_removed_.push_back(found->second.on_link.antenna.parameters.name);
  antennas_.erase(found);
}

void RfidWorld::set_materials(RadioWorldOptions materials) {
  const std::lock_guard lock(mutex_);
  if (materials_) throw Error("the world's materials are told already by another plugin");
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

gazebo::physics::LinkPtr RfidWorld::find_link(const std::string& name) const {
  return boost::dynamic_pointer_cast<gazebo::physics::Link>(world_->EntityByName(name));
}

void RfidWorld::describe(TagGroup& group) {
  std::vector<TagOnLink> tags = group.on_link.describe(*group.link);
  std::vector<std::string> taken;
  for (const TagOnLink& tag : tags) {
    if (!ids_.insert(tag.id).second) {
      for (const std::string& id : taken) ids_.erase(id);
      throw Error(fmt::format("there is a tag with the ID '{}' already", tag.id));
    }
    taken.push_back(tag.id);
  }
  for (std::size_t i = 0; i < tags.size(); ++i) group.numbers.push_back(free_number());
  group.tags = std::move(tags);
}

void RfidWorld::set_up(Antenna& antenna, Time now) {
  FieldAntenna field = antenna.on_link.antenna;
  // What is mounted for good has a known place.
  if (field.parent_frame.empty() && antenna.link->IsStatic()) field.parent_frame = kWorldFrame;
  if (!field.parent_frame.empty() && field.parent_frame != kWorldFrame) {
    const gazebo::physics::ModelPtr model = antenna.link->GetModel();
    antenna.parent = model->GetLink(field.parent_frame);
    if (!antenna.parent) {
      throw Error(fmt::format("<parent_frame> is '{}', expected a link of model '{}'",
                              field.parent_frame, model->GetName()));
    }
  }
  antenna.shared = std::make_shared<const FieldAntenna>(field);
  set_due(antenna, now);
}

/// Looks for the links of what was added since the last step. Between two steps all models are
/// whole; a link that is not there has gone again, and its plugin goes with it.
void RfidWorld::find_links(Time now) {
  if (all_found_) return;
  all_found_ = true;
  const auto find = [&](auto& entry, const std::string& link_name, const auto& set_up_entry,
                        const char* consequence) {
    if (entry.link || entry.refused) return;
    entry.link = find_link(link_name);
    all_found_ = all_found_ && entry.link;
    if (!entry.link) return;
    try {
      set_up_entry(entry);
    } catch (const std::exception& error) {
      entry.link.reset();
      // A tag that was deleted may hold its ID a little longer than its successor takes to come.
      if (!entry.faulty_since) entry.faulty_since = now;
      entry.refused = now - *entry.faulty_since >= kPatience || now < *entry.faulty_since;
      all_found_ = all_found_ && entry.refused;
      if (entry.refused) {
        gzerr << entry.on_link.place << ": " << error.what() << "; " << consequence << "\n";
      }
    }
  };
  for (TagGroup& group : groups_) {
    find(
        group, group.on_link.link, [&](TagGroup& found) { describe(found); }, "left out");
  }
  for (auto& [handle, antenna] : antennas_) {
    find(
        antenna, antenna.on_link.link, [&](Antenna& found) { set_up(found, now); }, "stays off");
  }
}

void RfidWorld::set_due(Antenna& antenna, Time from) const {
  const AntennaParameters& parameters = antenna.shared->parameters;
  antenna.due = update_stamp(parameters, first_update_at(parameters, from));
}

bool RfidWorld::is_due(Time now) const {
  return !antennas_removed_.empty() ||
         std::any_of(antennas_.begin(), antennas_.end(),
                     [&](const auto& entry) { return entry.second.due <= now; });
}

void RfidWorld::after_step() {
  const Time time = from_gazebo(world_->SimTime());
  on_step_(time);
  std::unique_lock lock(mutex_);
  find_links(last_ == Time::min() ? Time{} : time);
  if (time < last_) {  // The world was reset.
    for (auto& [handle, antenna] : antennas_) {
      if (antenna.link) set_due(antenna, time);
    }
  }
  last_ = time;
  if (!is_due(time)) return;
  const auto begin = std::chrono::steady_clock::now();
  FieldStep step = gather(time);
  if (step.added.empty()) {
    cost_.updates += static_cast<std::int64_t>(step.due.size());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    cost_.physics_s += took.count();
  }
  lock.unlock();
  // Not counted above: where this waits, it waits for the reads, which count themselves.
  worker_.post(std::move(step));
}

FieldStep RfidWorld::gather(Time now) {
  FieldStep step;
  step.stamp = now;
  step.removed.swap(removed_);
  step.antennas_removed.swap(antennas_removed_);
  gather_tags(step);
  gather_antennas(step);
  gather_world(step);
  return step;
}

/// What stands in the world is copied here and made ready for waves by the worker.
void RfidWorld::gather_world(FieldStep& step) {
  const bool is_of_use = std::any_of(step.due.begin(), step.due.end(), [](const AntennaDue& due) {
    return due.antenna->parameters.radio != nullptr;
  });
  if (!is_of_use || !solids_.has_changed()) return;
  step.world = std::make_shared<const FieldWorld>(
      FieldWorld{solids_.gather(), materials_.value_or(RadioWorldOptions{})});
}

void RfidWorld::gather_tags(FieldStep& step) {
  for (TagGroup& group : groups_) {
    if (!group.link) continue;
    const ignition::math::Pose3d& pose = group.link->WorldPose();
    if ((group.told && is_same(pose, group.X_WL)) || !pose.IsFinite()) continue;
    group.X_WL = pose;
    tell(group, step);
  }
}

/// Adds the group's tags, or moves them.
void RfidWorld::tell(TagGroup& group, FieldStep& step) {
  const RigidTransform X_WL = from_gazebo(group.X_WL);
  for (std::size_t i = 0; i < group.tags.size(); ++i) {
    const TagOnLink& tag = group.tags[i];
    if (group.told) {
      step.moved.push_back({group.numbers[i], X_WL * tag.X_LT});
    } else {
      step.added.push_back({group.numbers[i], tag.id, tag.label, X_WL * tag.X_LT, tag.model});
    }
  }
  group.told = true;
}

void RfidWorld::gather_antennas(FieldStep& step) {
  for (auto& [handle, antenna] : antennas_) {
    if (antenna.due > step.stamp) continue;
    set_due(antenna, step.stamp + Duration(1));
    AntennaDue due;
    due.antenna = antenna.shared;
    due.X_WA = from_gazebo(antenna.link->WorldPose()) * antenna.on_link.X_LA;
    if (!antenna.shared->parent_frame.empty()) {
      due.X_PA =
          antenna.parent ? from_gazebo(antenna.parent->WorldPose()).inverse() * due.X_WA : due.X_WA;
    }
    step.due.push_back(std::move(due));
  }
}

}  // namespace tagfield
