// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/gz_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <sdf/Element.hh>
#include <sdf/Sensor.hh>
#include <utility>

#include "adapters/gazebo_common/conversions.h"
#include "adapters/gz/custom_sensor.h"
#include "adapters/gz/entities.h"
#include "tagfield/base/error.h"
#include "tagfield/field/antenna_facts.h"

namespace tagfield {
namespace {

using gz_sim::Entity;
using gz_sim::EntityComponentManager;
namespace components = gz_sim::components;

constexpr const char* kWorldFrame = "world";

/// The sensor's pose in its link's frame, with `relative_to` resolved.
RigidTransform pose_on_link(Entity sensor, const EntityComponentManager& ecm) {
  const auto* const pose = ecm.Component<components::Pose>(sensor);
  return pose == nullptr ? RigidTransform{} : from_gazebo(pose->Data());
}

std::string world_name(const EntityComponentManager& ecm) {
  return name_of(ecm.EntityByComponents(components::World()), ecm);
}

}  // namespace

GzField::GzField(Outlets outlets, RadioWorldOptions materials)
    : materials_(std::move(materials)),
      worker_(std::move(outlets),
              {[](const std::string& warning) { report_warning("Tagfield: " + warning); },
               [](const std::string& error) { tell_error("Tagfield: " + error); }}) {}

GzField::Cost GzField::finish() {
  worker_.finish();
  Cost cost = cost_;
  cost.work = worker_.done();
  return cost;
}

void GzField::forget_sensors() {
  for (const TagGroup& group : groups_) {
    for (const std::uint32_t number : group.numbers) driver_.remove_tag(number);
  }
  for (const auto& [name, antenna] : antennas_) driver_.remove_antenna(name);
  groups_.clear();
  antennas_.clear();
  tags_in_.clear();
  has_looked_ = false;
  solids_.forget();
}

void GzField::after_step(Time now, bool is_paused, const EntityComponentManager& ecm) {
  if (now < last_) driver_.go_on(now);  // The world was rewound, or reset.
  last_ = now;
  solids_.look(ecm);
  find_sensors(now, ecm);
  const std::optional<Time> due = driver_.next_due();
  const bool updates = !is_paused && due && *due <= now;
  if (!driver_.has_news() && !updates) return;
  const auto begin = std::chrono::steady_clock::now();
  place_tags(now, ecm);
  std::vector<AntennaDue> ready;
  if (updates) ready = driver_.take_due(now);
  for (AntennaDue& antenna : ready) place(antenna, ecm);
  FieldStep step = driver_.take_step(now);
  step.due = std::move(ready);
  gather_world(step, ecm);
  if (step.added.empty()) {
    cost_.updates += static_cast<std::int64_t>(step.due.size());
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - begin;
    cost_.step_s += took.count();
  }
  // Not included above: if this blocks, it waits for the reads, which are counted separately.
  worker_.post(std::move(step));
}

/// Removals are processed before additions, which are in the order of the world's file.
void GzField::find_sensors(Time now, const EntityComponentManager& ecm) {
  ecm.EachRemoved<components::CustomSensor>([&](const Entity& sensor, const auto*) {
    remove_sensor(sensor);
    tags_in_.erase(parent_of(parent_of(sensor, ecm), ecm));
    return true;
  });
  std::map<Entity, sdf::Sensor> found;
  const auto note = [&](const Entity& sensor, const components::CustomSensor* description) {
    found.emplace(sensor, description->Data());
    return true;
  };
  if (std::exchange(has_looked_, true)) {
    ecm.EachNew<components::CustomSensor>(note);
  } else {
    ecm.Each<components::CustomSensor>(note);
  }
  for (const auto& [sensor, description] : found) {
    if (type_of(description) == kTagType) {
      tags_in_[parent_of(parent_of(sensor, ecm), ecm)].push_back(name_of(sensor, ecm));
    }
  }
  for (const auto& [sensor, description] : found) add_sensor(sensor, description, now, ecm);
}

void GzField::add_sensor(Entity sensor, const sdf::Sensor& description, Time now,
                         const EntityComponentManager& ecm) {
  const std::string type = type_of(description);
  const auto place = [&] { return place_of(place_of_sensor(sensor, ecm)); };
  try {
    if (type == kAntennaType) add_antenna(sensor, description.Element(), now, ecm);
    if (type == kTagType) add_tag(sensor, description.Element(), ecm);
    if (type == kTagSetType) add_tag_set(sensor, description.Element(), ecm);
    if (type.rfind("rfid", 0) == 0 && type != kAntennaType && type != kTagType &&
        type != kTagSetType) {
      throw Error(fmt::format("gz:type is '{}', expected {}, {} or {}", type, kAntennaType,
                              kTagType, kTagSetType));
    }
  } catch (const std::exception& error) {
    tell_error(fmt::format("{}: {}; {}", place(), error.what(),
                           type == kAntennaType ? "stays off" : "left out"));
  }
}

void GzField::add_antenna(Entity sensor, const sdf::ElementPtr& element, Time now,
                          const EntityComponentManager& ecm) {
  const SensorPlace at = place_of_sensor(sensor, ecm);
  Diagnostics diagnostics;
  FieldAntenna field = field_antenna(
      at.sensor, antenna_from(at.sensor, parameters_of(element, kAntennaType), {}, diagnostics));
  warn_of_silent(element, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    report_warning(place_of(at) + ": " + warning);
  }
  if (antennas_.count(field.parameters.name) > 0 && field.parameters.name == at.sensor) {
    put_model_in_front(at.model, field);
  }
  if (antennas_.count(field.parameters.name) > 0) {
    throw Error(
        fmt::format("there is an antenna called '{}' already; give this one another "
                    "<antenna>",
                    field.parameters.name));
  }
  const Antenna antenna = mounted(sensor, field, ecm);
  const auto shared = std::make_shared<const FieldAntenna>(std::move(field));
  driver_.add_antenna(shared);
  driver_.start(shared, now);
  antennas_.emplace(shared->parameters.name, antenna);
}

/// The antenna's pose on its link, and the parent of its frame.
GzField::Antenna GzField::mounted(Entity sensor, FieldAntenna& field,
                                  const EntityComponentManager& ecm) {
  Antenna antenna{sensor, parent_of(sensor, ecm), {}, false, pose_on_link(sensor, ecm)};
  field.is_fixed = is_static(sensor, ecm);
  // The pose of a permanently mounted antenna is known.
  antenna.reports_pose = field.is_fixed || !field.parent_frame.empty();
  if (field.parent_frame == kWorldFrame) field.parent_frame.clear();
  if (field.parent_frame.empty()) return antenna;
  const Entity model = parent_of(antenna.link, ecm);
  antenna.parent = link_named(field.parent_frame, model, ecm);
  if (antenna.parent) return antenna;
  throw Error(fmt::format("<parent_frame> is '{}', expected a link of model '{}'",
                          field.parent_frame, scoped_name_of(model, ecm)));
}

void GzField::add_tag(Entity sensor, const sdf::ElementPtr& element,
                      const EntityComponentManager& ecm) {
  const SensorPlace at = place_of_sensor(sensor, ecm);
  Diagnostics diagnostics;
  const SensorTag tag = tag_from(parameters_of(element, kTagType), {}, diagnostics);
  warn_of_silent(element, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    report_warning(place_of(at) + ": " + warning);
  }
  const std::string id =
      tag.epc ? *tag.epc : tag_id_of(at, tags_in_[parent_of(parent_of(sensor, ecm), ecm)]);
  const std::string label = fmt::format("{}::{}::{}", at.model, at.link, at.sensor);
  add_group(sensor, {{id, label, pose_on_link(sensor, ecm), tag.model}}, ecm);
}

void GzField::add_tag_set(Entity sensor, const sdf::ElementPtr& element,
                          const EntityComponentManager& ecm) {
  Diagnostics diagnostics;
  // Without messages: a missing file is reported once, with its location.
  const auto find = [&](const std::string& uri) {
    const std::string path = gz_sim::asFullPath(uri, element->FilePath());
    return gz_common::systemPaths()->FindFile(path, true, false);
  };
  std::vector<TagOnLink> tags =
      tag_set_in(described_in(element, kTagSetType), {}, find, diagnostics);
  warn_of_silent(element, diagnostics);
  for (const std::string& warning : diagnostics.warnings()) {
    report_warning(place_of(place_of_sensor(sensor, ecm)) + ": " + warning);
  }
  const RigidTransform X_LS = pose_on_link(sensor, ecm);
  for (TagOnLink& tag : tags) tag.X_LT = X_LS * tag.X_LT;
  add_group(sensor, std::move(tags), ecm);
}

void GzField::add_group(Entity sensor, std::vector<TagOnLink> tags,
                        const EntityComponentManager& ecm) {
  TagGroup group;
  group.sensor = sensor;
  group.link = parent_of(sensor, ecm);
  try {
    for (const TagOnLink& tag : tags) {
      group.numbers.push_back(driver_.add_tag(tag.id, tag.label, tag.model));
    }
  } catch (const Error&) {
    for (const std::uint32_t number : group.numbers) driver_.remove_tag(number);
    throw;
  }
  group.tags = std::move(tags);
  groups_.push_back(std::move(group));
}

void GzField::remove_sensor(Entity sensor) {
  const auto group = std::find_if(groups_.begin(), groups_.end(),
                                  [&](const TagGroup& known) { return known.sensor == sensor; });
  if (group != groups_.end()) {
    for (const std::uint32_t number : group->numbers) driver_.remove_tag(number);
    groups_.erase(group);
    return;
  }
  const auto antenna = std::find_if(antennas_.begin(), antennas_.end(), [&](const auto& known) {
    return known.second.sensor == sensor;
  });
  if (antenna == antennas_.end()) return;
  driver_.remove_antenna(antenna->first);
  antennas_.erase(antenna);
}

void GzField::place_tags(Time now, const EntityComponentManager& ecm) {
  for (TagGroup& group : groups_) {
    const gz_math::Pose3d pose = gz_sim::worldPose(group.link, ecm);
    if ((group.is_placed && is_same(pose, group.X_WL)) || !pose.IsFinite()) continue;
    group.X_WL = pose;
    group.is_placed = true;
    const RigidTransform X_WL = from_gazebo(pose);
    for (std::size_t i = 0; i < group.tags.size(); ++i) {
      driver_.place_tag(group.numbers[i], X_WL * group.tags[i].X_LT, now);
    }
  }
}

void GzField::place(AntennaDue& due, const EntityComponentManager& ecm) const {
  const Antenna& antenna = antennas_.at(due.antenna->parameters.name);
  due.X_WA = from_gazebo(gz_sim::worldPose(antenna.link, ecm)) * antenna.X_LA;
  if (!antenna.reports_pose) return;
  due.X_PA = antenna.parent
                 ? from_gazebo(gz_sim::worldPose(*antenna.parent, ecm)).inverse() * due.X_WA
                 : due.X_WA;
}

/// The static world is copied here; the worker prepares it for wave propagation.
void GzField::gather_world(FieldStep& step, const EntityComponentManager& ecm) {
  const bool is_of_use = std::any_of(step.due.begin(), step.due.end(), [](const AntennaDue& due) {
    return meets_world(due.antenna->parameters);
  });
  if (!is_of_use || !solids_.has_changed(ecm)) return;
  step.world = std::make_shared<const FieldWorld>(
      FieldWorld{solids_.gather(world_name(ecm), ecm), materials_});
}

}  // namespace tagfield
