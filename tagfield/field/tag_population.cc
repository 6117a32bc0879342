#include "tagfield/field/tag_population.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield {

void TagPopulation::add(std::uint32_t slot, const std::string& id, const Eigen::Vector3d& p_WT) {
  if (has(slot)) throw Error(fmt::format("there is a tag of number {} already", slot));
  if (ids_.count(id) != 0) {
    throw Error(fmt::format("there is a tag with the ID '{}' already", id));
  }
  index_.place(slot, p_WT);
  if (slot >= tags_.size()) tags_.resize(slot + std::size_t{1});
  tags_[slot] = {id, stream_key(id), true, Eigen::Quaterniond::Identity(), models_.front().get()};
  ids_.insert(id);
}

void TagPopulation::set_model(std::uint32_t slot, std::shared_ptr<const TagModel> model) {
  tags_[slot].model = model.get();
  if (std::find(models_.begin(), models_.end(), model) == models_.end()) {
    models_.push_back(std::move(model));
  }
}

void TagPopulation::remove(std::uint32_t slot) {
  ids_.erase(tags_[slot].id);
  tags_[slot].present = false;
  index_.remove(slot);
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
