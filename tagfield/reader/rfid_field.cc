#include "tagfield/reader/rfid_field.h"

#include <fmt/format.h>

#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

/// Half of the published antennas' range, so that a query visits some 30 columns.
constexpr double kCell = 3.5;

}  // namespace

RfidField::RfidField(std::vector<std::unique_ptr<FieldListener>> listeners)
    : listeners_(std::move(listeners)), tags_(kCell) {}

std::uint32_t RfidField::slot_of(std::uint32_t number) const {
  if (number >= slots_.size() || !slots_[number]) {
    throw Error(fmt::format("there is no tag of number {}", number));
  }
  return *slots_[number];
}

void RfidField::remove(std::uint32_t number) {
  const std::uint32_t slot = slot_of(number);
  tags_.population.remove(slot);
  tags_.labels[slot].clear();
  slots_[number].reset();
}

void RfidField::add(const TagAdded& tag) {
  if (!tag.p_WT.allFinite()) {
    throw Error(fmt::format("tag '{}' is not at a finite place", tag.id));
  }
  if (tag.number < slots_.size() && slots_[tag.number]) {
    throw Error(fmt::format("there is a tag of number {} already", tag.number));
  }
  const std::uint32_t slot = tags_.population.add(tag.id, tag.p_WT);
  if (slot >= tags_.labels.size()) tags_.labels.resize(slot + std::size_t{1});
  tags_.labels[slot] = tag.label;
  if (tag.number >= slots_.size()) slots_.resize(tag.number + std::size_t{1});
  slots_[tag.number] = slot;
}

void RfidField::move(const std::vector<TagMoved>& moved) {
  moved_slots_.clear();
  for (const TagMoved& tag : moved) {
    if (!tag.p_WT.allFinite()) continue;
    const std::uint32_t slot = slot_of(tag.number);
    tags_.population.move(slot, tag.p_WT);
    moved_slots_.push_back(slot);
  }
}

void RfidField::update(const AntennaDue& due, Time stamp) {
  const bool finite = due.X_WA.translation.allFinite() && due.X_WA.rotation.coeffs().allFinite();
  if (!finite) return;
  const FieldAntenna& antenna = *due.antenna;
  read_tags(antenna.parameters, due.X_WA.translation, stamp, antenna.seed, tags_.population,
            replies_);
  reads_ += static_cast<std::int64_t>(replies_.size());
  const AntennaUpdate update{stamp, antenna, due.X_WA, due.X_PA, replies_, tags_};
  for (const auto& listener : listeners_) listener->antenna_updated(update);
}

void RfidField::step(const FieldStep& step) {
  for (const std::string& antenna : step.antennas_removed) {
    for (const auto& listener : listeners_) listener->antenna_removed(antenna);
  }
  for (const auto& antenna : step.antennas_added) {
    for (const auto& listener : listeners_) listener->antenna_added(*antenna);
  }
  for (const std::uint32_t number : step.removed) remove(number);
  for (const TagAdded& tag : step.added) add(tag);
  move(step.moved);
  for (const auto& listener : listeners_) {
    if (!step.removed.empty() || !step.added.empty()) listener->tags_changed(step.stamp, tags_);
    if (!moved_slots_.empty()) listener->tags_moved(step.stamp, moved_slots_, tags_);
  }
  for (const AntennaDue& due : step.due) update(due, step.stamp);
}

}  // namespace tagfield
