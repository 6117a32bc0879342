#include "tagfield/field/tag_population.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {

std::uint32_t TagPopulation::free_slot() {
  if (free_slots_.empty()) return static_cast<std::uint32_t>(tags_.size());
  return free_slots_.back();
}

std::uint32_t TagPopulation::add(const std::string& id, const Eigen::Vector3d& p_WT) {
  if (slots_.count(id) != 0)
    throw Error(fmt::format("there is a tag with the ID '{}' already", id));
  const std::uint32_t slot = free_slot();
  index_.place(slot, p_WT);
  if (slot == tags_.size()) {
    tags_.emplace_back();
  } else {
    free_slots_.pop_back();
  }
  tags_[slot] = {id, stream_key(id), true, Eigen::Quaterniond::Identity(), models_.front().get()};
  slots_.emplace(id, slot);
  return slot;
}

void TagPopulation::set_model(std::uint32_t slot, std::shared_ptr<const TagModel> model) {
  tags_[slot].model = model.get();
  if (std::find(models_.begin(), models_.end(), model) == models_.end()) {
    models_.push_back(std::move(model));
  }
}

void TagPopulation::remove(std::uint32_t slot) {
  slots_.erase(tags_[slot].id);
  tags_[slot].present = false;
  index_.remove(slot);
  free_slots_.push_back(slot);
}

std::optional<std::uint32_t> TagPopulation::find(const std::string& id) const {
  const auto found = slots_.find(id);
  if (found == slots_.end()) return std::nullopt;
  return found->second;
}

void read_tags(const AntennaParameters& antenna, const Eigen::Vector3d& p_WA, Time stamp,
               std::uint64_t seed, const TagPopulation& tags, std::vector<TagReply>& replies) {
  replies.clear();
  const std::uint64_t antenna_key = stream_key(antenna.name);
  std::vector<std::uint32_t> slots;
  tags.index().within(p_WA, perturbed_range(antenna, stamp, seed), slots);
  replies.reserve(slots.size());
  const double frequency_hz = paper(antenna).model.frequency_hz;
  for (const std::uint32_t slot : slots) {
    const LinkGeometry link = link_between(p_WA, tags.position(slot));
    const Signal signal = read_signal(antenna, antenna_key, tags.key(slot), link, stamp, seed);
    replies.push_back({slot, stamp, frequency_hz, signal.phase_rad, signal.rssi_dbm,
                       link.distance_m, std::nullopt});
  }
}

TagRead to_read(const AntennaParameters& antenna, const std::string& tag, const TagReply& reply) {
  return {reply.stamp,        antenna.reader,  antenna.name,   tag,
          reply.frequency_hz, reply.phase_rad, reply.rssi_dbm, reply.doppler_hz};
}

}  // namespace tagfield
