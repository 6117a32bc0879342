// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_population.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {
namespace {

constexpr std::size_t kAtOnce = 256;

/// Up to kAtOnce tags.
void read_some(const AntennaParameters& antenna, std::uint64_t antenna_key,
               const Eigen::Vector3d& p_WA, Time stamp, std::uint64_t seed,
               const TagPopulation& tags, std::span<const std::uint32_t> slots,
               std::vector<TagReply>& replies) {
  std::array<std::uint64_t, kAtOnce> keys;
  std::array<double, kAtOnce> distances_m;
  std::array<double, kAtOnce> phases_rad;
  std::array<double, kAtOnce> rssis_dbm;
  const std::size_t count = slots.size();
  for (std::size_t i = 0; i < count; ++i) {
    keys[i] = tags.key(slots[i]);
    distances_m[i] = link_between(p_WA, tags.position(slots[i])).distance_m;
  }
  read_signals(antenna, antenna_key, {keys.data(), count}, {distances_m.data(), count}, stamp, seed,
               {phases_rad.data(), count}, {rssis_dbm.data(), count});
  const double frequency_hz = paper(antenna).model.frequency_hz;
  const double min_dbm =
      paper(antenna).sensitivity_dbm.value_or(-std::numeric_limits<double>::infinity());
  for (std::size_t i = 0; i < count; ++i) {
    if (rssis_dbm[i] < min_dbm) continue;
    // Member by member, because copying a struct that was assembled elsewhere stalls here.
    TagReply& reply = replies.emplace_back();
    reply.slot = slots[i];
    reply.stamp = stamp;
    reply.frequency_hz = frequency_hz;
    reply.phase_rad = phases_rad[i];
    reply.rssi_dbm = rssis_dbm[i];
    reply.distance_m = distances_m[i];
  }
}

}  // namespace

void TagPopulation::add(std::uint32_t slot, const std::string& id, const Eigen::Vector3d& p_WT) {
  if (has(slot)) throw Error(fmt::format("there is a tag of number {} already", slot));
  if (ids_.count(id) != 0) {
    throw Error(fmt::format("there is a tag with the ID '{}' already", id));
  }
  index_.place(slot, p_WT);
  if (slot >= tags_.size()) {
    tags_.resize(slot + std::size_t{1});
    keys_.resize(slot + std::size_t{1});
  }
  keys_[slot] = stream_key(id);
  tags_[slot] = {id, true, Eigen::Quaterniond::Identity(), models_.front().get()};
  ids_.insert(id);
  ++version_;
}

void TagPopulation::set_model(std::uint32_t slot, std::shared_ptr<const TagModel> model) {
  ++version_;
  tags_[slot].model = model.get();
  if (std::find(models_.begin(), models_.end(), model) == models_.end()) {
    models_.push_back(std::move(model));
  }
}

void TagPopulation::remove(std::uint32_t slot) {
  ids_.erase(tags_[slot].id);
  tags_[slot].present = false;
  index_.remove(slot);
  ++version_;
}

void read_tags(const AntennaParameters& antenna, const Eigen::Vector3d& p_WA, Time stamp,
               std::uint64_t seed, const TagPopulation& tags,
               const std::function<void(std::span<const TagReply>)>& take) {
  const std::uint64_t antenna_key = stream_key(antenna.name);
  std::vector<std::uint32_t> slots;
  tags.index().within(p_WA, perturbed_range(antenna, stamp, seed), slots);
  std::vector<TagReply> replies;
  replies.reserve(std::min(kAtOnce, slots.size()));
  for (std::size_t begin = 0; begin < slots.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, slots.size() - begin);
    replies.clear();
    read_some(antenna, antenna_key, p_WA, stamp, seed, tags, {slots.data() + begin, count},
              replies);
    if (!replies.empty()) take(replies);
  }
}

TagRead to_read(const AntennaParameters& antenna, const std::string& tag, const TagReply& reply) {
  return {reply.stamp,        antenna.reader,  antenna.name,   tag,
          reply.frequency_hz, reply.phase_rad, reply.rssi_dbm, reply.doppler_hz};
}

}  // namespace tagfield
