#include "tagfield/field/rfid_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// Half of the published antennas' range, so that a query visits some 30 columns.
constexpr double kCell = 3.5;

bool is_finite(const RigidTransform& X) {
  return X.translation.allFinite() && X.rotation.coeffs().allFinite();
}

std::shared_ptr<const RadioWorld> made(const FieldWorld& world, Diagnostics& diagnostics) {
  return std::make_shared<const RadioWorld>(radio_world(world.scene, world.materials, diagnostics));
}

}  // namespace

RfidField::RfidField(std::vector<std::unique_ptr<FieldListener>> listeners)
    : listeners_(std::move(listeners)), tags_(kCell) {}

std::uint32_t RfidField::slot_of(std::uint32_t number) const {
  if (number >= slots_.size() || !slots_[number]) {
    throw Error(fmt::format("there is no tag of number {}", number));
  }
  return *slots_[number];
}

void RfidField::add_antenna(const std::shared_ptr<const FieldAntenna>& antenna) {
  if (antenna->parameters.radio) {
    if (!world_) world_ = made({}, diagnostics_);
    if (!air_) air_.emplace(world_, antenna->seed);
    air_->add(antenna->parameters, antenna->seed);
    physical_.push_back(antenna);
  }
  for (const auto& listener : listeners_) listener->antenna_added(*antenna);
}

void RfidField::remove_antenna(const std::string& name) {
  if (air_) air_->remove(name);
  physical_.erase(
      std::remove_if(physical_.begin(), physical_.end(),
                     [&](const auto& antenna) { return antenna->parameters.name == name; }),
      physical_.end());
  for (const auto& listener : listeners_) listener->antenna_removed(name);
}

void RfidField::set_world(const FieldWorld& world) {
  try {
    world_ = made(world, diagnostics_);
  } catch (const Error& error) {
    diagnostics_.warn(fmt::format("the world is not taken over for waves: {}", error.what()));
    return;
  }
  if (air_) air_->set_world(world_);
}

/// The air with the antennas that there are, which remember nothing.
void RfidField::begin_anew() {
  if (!air_) return;
  air_.emplace(world_, 0);
  for (const auto& antenna : physical_) air_->add(antenna->parameters, antenna->seed);
}

std::vector<std::string> RfidField::take_warnings() {
  const std::vector<std::string>& all = diagnostics_.warnings();
  std::vector<std::string> fresh(
      std::next(all.begin(), static_cast<std::ptrdiff_t>(warnings_taken_)), all.end());
  warnings_taken_ = all.size();
  return fresh;
}

void RfidField::remove(std::uint32_t number) {
  const std::uint32_t slot = slot_of(number);
  if (air_) air_->forget_tag(slot);
  tags_.population.remove(slot);
  tags_.labels[slot].clear();
  slots_[number].reset();
}

void RfidField::add(const TagAdded& tag) {
  if (!is_finite(tag.X_WT)) {
    throw Error(fmt::format("tag '{}' is not at a finite place", tag.id));
  }
  if (tag.number < slots_.size() && slots_[tag.number]) {
    throw Error(fmt::format("there is a tag of number {} already", tag.number));
  }
  const std::uint32_t slot = tags_.population.add(tag.id, tag.X_WT.translation);
  tags_.population.turn(slot, tag.X_WT.rotation);
  if (tag.model) tags_.population.set_model(slot, tag.model);
  if (slot >= tags_.labels.size()) tags_.labels.resize(slot + std::size_t{1});
  tags_.labels[slot] = tag.label;
  if (tag.number >= slots_.size()) slots_.resize(tag.number + std::size_t{1});
  slots_[tag.number] = slot;
}

void RfidField::move(const std::vector<TagMoved>& moved) {
  moved_slots_.clear();
  for (const TagMoved& tag : moved) {
    if (!is_finite(tag.X_WT)) continue;
    const std::uint32_t slot = slot_of(tag.number);
    tags_.population.move(slot, tag.X_WT.translation);
    tags_.population.turn(slot, tag.X_WT.rotation);
    moved_slots_.push_back(slot);
  }
}

void RfidField::read(const AntennaDue& due, Time stamp) {
  const FieldAntenna& antenna = *due.antenna;
  const AntennaParameters& parameters = antenna.parameters;
  if (!parameters.radio) {
    read_tags(parameters, due.X_WA.translation, stamp, antenna.seed, tags_.population, replies_);
  } else if (air_) {
    air_->update(parameters.name, due.X_WA, stamp, tags_.population, replies_);
  } else {
    throw Error(fmt::format("there is no antenna '{}' in the air", parameters.name));
  }
}

void RfidField::update(const AntennaDue& due, Time stamp) {
  if (!is_finite(due.X_WA)) return;
  const FieldAntenna& antenna = *due.antenna;
  read(due, stamp);
  reads_ += static_cast<std::int64_t>(replies_.size());
  const AntennaUpdate update{stamp, antenna, due.X_WA, due.X_PA, replies_, tags_};
  for (const auto& listener : listeners_) listener->antenna_updated(update);
}

void RfidField::step(const FieldStep& step) {
  for (const std::string& antenna : step.antennas_removed) remove_antenna(antenna);
  if (step.world) set_world(*step.world);
  for (const auto& antenna : step.antennas_added) add_antenna(antenna);
  for (const std::uint32_t number : step.removed) remove(number);
  for (const TagAdded& tag : step.added) add(tag);
  move(step.moved);
  for (const auto& listener : listeners_) {
    if (!step.removed.empty() || !step.added.empty()) listener->tags_changed(step.stamp, tags_);
    if (!moved_slots_.empty()) listener->tags_moved(step.stamp, moved_slots_, tags_);
  }
  if (step.due.empty()) return;
  if (updated_ && step.stamp < *updated_) begin_anew();
  updated_ = step.stamp;
  for (const AntennaDue& due : step.due) update(due, step.stamp);
}

}  // namespace tagfield
