// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/tag_population.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <span>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/channel/paper_model.h"

namespace tagfield {
namespace {

constexpr std::size_t kAtOnce = 256;

/// The part of the results that is strong enough, in the same arrays.
std::size_t without_weak(double min_dbm, std::size_t count, std::span<std::uint32_t> slots,
                         std::span<double> phases_rad, std::span<double> rssis_dbm,
                         std::span<double> distances_m) {
  std::size_t kept = 0;
  for (std::size_t i = 0; i < count; ++i) {
    if (rssis_dbm[i] < min_dbm) continue;
    slots[kept] = slots[i];
    phases_rad[kept] = phases_rad[i];
    rssis_dbm[kept] = rssis_dbm[i];
    distances_m[kept] = distances_m[i];
    ++kept;
  }
  return kept;
}

/// Up to kAtOnce of the tags in range, from `begin` on.
void read_some(const AntennaParameters& antenna, std::uint64_t antenna_key, Time stamp,
               std::uint64_t seed, const NearTags& near, std::size_t begin, std::size_t count,
               const std::function<void(const PaperReads&)>& take) {
  std::array<double, kAtOnce> phases_rad;
  std::array<double, kAtOnce> rssis_dbm;
  const auto slots = std::span(near.slots).subspan(begin, count);
  const auto distances_m = std::span(near.distances_m).subspan(begin, count);
  read_signals(antenna, antenna_key, std::span(near.keys).subspan(begin, count), distances_m, stamp,
               seed, {phases_rad.data(), count}, {rssis_dbm.data(), count});
  const double frequency_hz = paper(antenna).model.frequency_hz;
  const std::optional<double>& min_dbm = paper(antenna).sensitivity_dbm;
  if (!min_dbm) {
    take({slots, {phases_rad.data(), count}, {rssis_dbm.data(), count}, distances_m, frequency_hz});
    return;
  }
  std::array<std::uint32_t, kAtOnce> kept_slots;
  std::array<double, kAtOnce> kept_distances_m;
  std::copy(slots.begin(), slots.end(), kept_slots.begin());
  std::copy(distances_m.begin(), distances_m.end(), kept_distances_m.begin());
  const std::size_t kept =
      without_weak(*min_dbm, count, kept_slots, phases_rad, rssis_dbm, kept_distances_m);
  if (kept == 0) return;
  take({{kept_slots.data(), kept},
        {phases_rad.data(), kept},
        {rssis_dbm.data(), kept},
        {kept_distances_m.data(), kept},
        frequency_hz});
}

/// If ranges are perturbed, most are less than this multiple of one of them.
constexpr double kMoreRange = 1.25;

void resize(std::size_t count, NearTags& near) {
  near.slots.resize(count);
  near.keys.resize(count);
  near.distances_m.resize(count);
}

void look_around(const Eigen::Vector3d& p_WA, double reach_m, const TagPopulation& tags,
                 TagsInRange& near) {
  near.tags = &tags;
  near.version = tags.version();
  near.p_WA = p_WA;
  near.reach_m = reach_m;
  near.farthest_m = 0.0;
  tags.index().within(p_WA, near.reach_m, near.all.slots);
  resize(near.all.slots.size(), near.all);
  for (std::size_t i = 0; i < near.all.slots.size(); ++i) {
    near.all.keys[i] = tags.key(near.all.slots[i]);
    const double distance_m = link_between(p_WA, tags.position(near.all.slots[i])).distance_m;
    near.all.distances_m[i] = distance_m;
    near.farthest_m = std::max(near.farthest_m, distance_m);
  }
}

/// The tags within the range, in columns of `near`.
const NearTags& in_range(const Eigen::Vector3d& p_WA, double range_m, const TagPopulation& tags,
                         TagsInRange& near) {
  const bool is_at_rest = near.tags == &tags && near.version == tags.version() && near.p_WA == p_WA;
  if (!is_at_rest) {
    look_around(p_WA, range_m, tags, near);
    return near.all;
  }
  if (range_m > near.reach_m) {
    look_around(p_WA, kMoreRange * range_m, tags, near);
  }
  if (near.farthest_m <= range_m) return near.all;
  // Each is written, but counted only if in range: branches would be mispredicted.
  const NearTags& all = near.all;
  NearTags& part = near.part;
  resize(all.slots.size(), part);
  std::size_t count = 0;
  for (std::size_t i = 0; i < all.slots.size(); ++i) {
    part.slots[count] = all.slots[i];
    part.keys[count] = all.keys[i];
    part.distances_m[count] = all.distances_m[i];
    count += all.distances_m[i] <= range_m ? 1U : 0U;
  }
  resize(count, part);
  return part;
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
               std::uint64_t seed, const TagPopulation& tags, TagsInRange& near,
               const std::function<void(const PaperReads&)>& take) {
  const std::uint64_t antenna_key = stream_key(antenna.name);
  const NearTags& now = in_range(p_WA, perturbed_range(antenna, stamp, seed), tags, near);
  for (std::size_t begin = 0; begin < now.slots.size(); begin += kAtOnce) {
    const std::size_t count = std::min(kAtOnce, now.slots.size() - begin);
    read_some(antenna, antenna_key, stamp, seed, now, begin, count, take);
  }
}

TagReply to_reply(const PaperReads& reads, std::size_t i, Time stamp) {
  TagReply reply;
  reply.slot = reads.slots[i];
  reply.stamp = stamp;
  reply.frequency_hz = reads.frequency_hz;
  reply.phase_rad = reads.phases_rad[i];
  reply.rssi_dbm = reads.rssis_dbm[i];
  reply.distance_m = reads.distances_m[i];
  return reply;
}

TagRead to_read(const AntennaParameters& antenna, const std::string& tag, const TagReply& reply) {
  return {reply.stamp,        antenna.reader,  antenna.name,   tag,
          reply.frequency_hz, reply.phase_rad, reply.rssi_dbm, reply.doppler_hz};
}

}  // namespace tagfield
