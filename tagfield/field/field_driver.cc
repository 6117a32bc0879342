// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/field_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

template <class Items>
void forget(Items& items, std::uint32_t number) {
  items.erase(std::remove_if(items.begin(), items.end(),
                             [&](const auto& item) { return item.number == number; }),
              items.end());
}

}  // namespace

std::uint32_t FieldDriver::add_tag(const std::string& id, const std::string& label,
                                   std::shared_ptr<const TagModel> model) {
  if (!ids_.insert(id).second) {
    throw Error(fmt::format("there is a tag with the ID '{}' already", id));
  }
  auto number = static_cast<std::uint32_t>(tags_.size());
  if (free_numbers_.empty()) {
    tags_.emplace_back();
  } else {
    number = free_numbers_.back();
    free_numbers_.pop_back();
  }
  tags_[number] = {id, label, std::move(model)};
  return number;
}

void FieldDriver::place_tag(std::uint32_t number, const RigidTransform& X_WT, Time since) {
  if (!is_finite(X_WT)) return;
  Tag& tag = tags_[number];
  if (tag.is_placed) {
    next_.moved.push_back({number, X_WT});
  } else {
    next_.added.push_back({number, tag.id, tag.label, X_WT, tag.model, since});
  }
  tag.is_placed = true;
}

void FieldDriver::remove_tag(std::uint32_t number) {
  Tag& tag = tags_[number];
  ids_.erase(tag.id);
  const std::size_t added = next_.added.size();
  forget(next_.added, number);
  forget(next_.moved, number);
  // Within a step, the field removes tags before it adds others, so a number can be reused
  // immediately.
  if (tag.is_placed && next_.added.size() == added) next_.removed.push_back(number);
  tag = {};
  free_numbers_.push_back(number);
}

std::shared_ptr<const FieldAntenna> FieldDriver::antenna(const std::string& name) const {
  const auto found = std::find_if(antennas_.begin(), antennas_.end(), [&](const Antenna& antenna) {
    return antenna.antenna->parameters.name == name;
  });
  return found == antennas_.end() ? nullptr : found->antenna;
}

bool FieldDriver::has_antenna(const std::string& name) const { return antenna(name) != nullptr; }

void FieldDriver::add_antenna(const std::shared_ptr<const FieldAntenna>& antenna) {
  const std::string& name = antenna->parameters.name;
  if (has_antenna(name)) {
    throw Error(fmt::format("there is an antenna called '{}' already", name));
  }
  antennas_.push_back({antenna, {}, Time::max(), false});
  next_.antennas_added.push_back(antenna);
}

void FieldDriver::remove_antenna(const std::string& name) {
  const auto is_it = [&](const auto& antenna) { return antenna->parameters.name == name; };
  const auto found = std::find_if(antennas_.begin(), antennas_.end(),
                                  [&](const Antenna& entry) { return is_it(entry.antenna); });
  if (found == antennas_.end()) return;
  antennas_.erase(found);
  auto& added = next_.antennas_added;
  const auto fresh = std::find_if(added.begin(), added.end(), is_it);
  if (fresh != added.end()) {
    added.erase(fresh);
  } else {
    next_.antennas_removed.push_back(name);
  }
}

Time FieldDriver::first_due(const Antenna& antenna, Time from) {
  const AntennaParameters& parameters = antenna.antenna->parameters;
  if (antenna.at.empty()) return update_stamp(parameters, first_update_at(parameters, from));
  const auto next = std::lower_bound(antenna.at.begin(), antenna.at.end(), from);
  return next == antenna.at.end() ? Time::max() : *next;
}

void FieldDriver::start(const std::shared_ptr<const FieldAntenna>& antenna, Time from,
                        std::vector<Time> at) {
  const auto entry = std::find_if(antennas_.begin(), antennas_.end(), [&](const Antenna& known) {
    return known.antenna->parameters.name == antenna->parameters.name;
  });
  if (entry == antennas_.end()) return;
  entry->antenna = antenna;
  entry->at = std::move(at);
  entry->due = first_due(*entry, from);
  entry->has_started = true;
}

void FieldDriver::go_on(Time from) {
  for (Antenna& antenna : antennas_) {
    if (antenna.has_started) antenna.due = first_due(antenna, from);
  }
}

std::optional<Time> FieldDriver::next_due() const {
  Time next = Time::max();
  for (const Antenna& antenna : antennas_) next = std::min(next, antenna.due);
  if (next == Time::max()) return std::nullopt;
  return next;
}

std::vector<AntennaDue> FieldDriver::take_due(Time now) {
  std::vector<AntennaDue> due;
  for (Antenna& antenna : antennas_) {
    if (antenna.due > now) continue;
    antenna.due = first_due(antenna, now + Duration(1));
    due.push_back({antenna.antenna, {}, std::nullopt, antenna.due == Time::max()});
  }
  return due;
}

bool FieldDriver::has_news() const {
  return !next_.added.empty() || !next_.removed.empty() || !next_.antennas_added.empty() ||
         !next_.antennas_removed.empty();
}

FieldStep FieldDriver::take_step(Time stamp) {
  next_.stamp = stamp;
  return std::exchange(next_, {});
}

}  // namespace tagfield
