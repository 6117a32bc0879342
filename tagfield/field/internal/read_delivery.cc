// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/internal/read_delivery.h"

#include <algorithm>
#include <utility>

namespace tagfield {

void ReadDelivery::push(Time stamp, What what) {
  is_sorted_ = is_sorted_ && (events_.empty() || events_.back().stamp <= stamp);
  events_.push_back({stamp, std::move(what)});
}

void ReadDelivery::add(const TagRead& read, double distance_m) {
  ++reads_;
  push(read.stamp, Read{read, distance_m});
}

void ReadDelivery::add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
                       const TagPopulation& tags, const Eigen::Vector3d& p_WA) {
  push(stamp, Unmade{antenna, &tags, p_WA});
}

void ReadDelivery::add(const std::shared_ptr<const FieldAntenna>& antenna, Time stamp,
                       const TagPopulation& tags, std::vector<TagReply>& replies) {
  if (replies.empty()) return;
  reads_ += static_cast<std::int64_t>(replies.size());
  Reads reads{antenna, &tags, {}};
  if (!spare_.empty()) {
    reads.replies = std::move(spare_.back());
    spare_.pop_back();
  }
  reads.replies.swap(replies);
  push(stamp, std::move(reads));
}

void ReadDelivery::add(const std::shared_ptr<const AntennaInfo>& antenna, Time stamp,
                       const RigidTransform& X_WA, const std::optional<RigidTransform>& X_PA) {
  push(stamp, Update{antenna, X_WA, X_PA});
}

void ReadDelivery::add(Time stamp, const TagPosition& tag, std::optional<std::string> label) {
  push(stamp, Place{tag, std::move(label)});
}

void ReadDelivery::add_removed(Time stamp, const std::string& tag) { push(stamp, Removed{tag}); }
void ReadDelivery::add_placed(Time stamp) { push(stamp, Placed{}); }
void ReadDelivery::add_robot(const AntennaPose& robot) { push(robot.stamp, robot); }

void ReadDelivery::tell(Time /*stamp*/, const Read& read) const {
  const TagRead& delivered = read.read;
  const TrueDistance distance{delivered.stamp, delivered.antenna, delivered.tag, read.distance_m};
  for (const auto& listener : outlets_.truth) listener->on_distance(distance);
  for (const auto& listener : outlets_.reads) listener->on_read(delivered);
}

/// At most a few hundred reads, so that all data is still in the cache when the listeners get it.
void ReadDelivery::tell_together(const AntennaParameters& antenna, Time stamp,
                                 const TagPopulation& tags, std::span<const TagReply> replies) {
  rows_.resize(replies.size());
  distance_rows_.resize(replies.size());
  // Member by member, because copying a struct that was assembled elsewhere stalls here.
  for (std::size_t i = 0; i < replies.size(); ++i) {
    const TagReply& reply = replies[i];
    ReadBatch::Row& row = rows_[i];
    row.tag = &tags.id(reply.slot);
    row.frequency_hz = reply.frequency_hz;
    row.phase_rad = reply.phase_rad;
    row.rssi_dbm = reply.rssi_dbm;
    row.doppler_hz = reply.doppler_hz;
    distance_rows_[i].tag = row.tag;
    distance_rows_[i].distance_m = reply.distance_m;
  }
  tell_rows(antenna, stamp);
}

/// Same, directly from columns.
void ReadDelivery::tell_together(const AntennaParameters& antenna, Time stamp,
                                 const TagPopulation& tags, const PaperReads& reads) {
  rows_.resize(reads.slots.size());
  distance_rows_.resize(reads.slots.size());
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    ReadBatch::Row& row = rows_[i];
    row.tag = &tags.id(reads.slots[i]);
    row.frequency_hz = reads.frequency_hz;
    row.phase_rad = reads.phases_rad[i];
    row.rssi_dbm = reads.rssis_dbm[i];
    row.doppler_hz.reset();
    distance_rows_[i].tag = row.tag;
    distance_rows_[i].distance_m = reads.distances_m[i];
  }
  tell_rows(antenna, stamp);
}

void ReadDelivery::tell_rows(const AntennaParameters& antenna, Time stamp) const {
  for (const auto& listener : outlets_.truth) {
    listener->on_distances({stamp, antenna.name, distance_rows_});
  }
  for (const auto& listener : outlets_.reads) {
    listener->on_reads({stamp, antenna.reader, antenna.name, rows_});
  }
}

void ReadDelivery::tell(Time stamp, const Reads& reads) {
  constexpr std::size_t kAtOnce = 256;
  const std::span<const TagReply> all(reads.replies);
  for (std::size_t begin = 0; begin < all.size(); begin += kAtOnce) {
    tell_together(reads.antenna->parameters, stamp, *reads.tags,
                  all.subspan(begin, std::min(kAtOnce, all.size() - begin)));
  }
}

TagsInRange& ReadDelivery::in_range_of(const std::shared_ptr<const FieldAntenna>& antenna) {
  const auto found = in_range_.find(antenna);
  if (found != in_range_.end()) return found->second;
  // Antennas that nobody else knows any more.
  std::erase_if(in_range_, [](const auto& entry) { return entry.first.use_count() == 1; });
  return in_range_[antenna];
}

void ReadDelivery::make(Time stamp, const Unmade& unmade,
                        const std::function<void(const PaperReads&)>& take) {
  const FieldAntenna& antenna = *unmade.antenna;
  read_tags(antenna.parameters, unmade.p_WA, stamp, antenna.seed, *unmade.tags,
            in_range_of(unmade.antenna), [&](const PaperReads& reads) {
              reads_ += static_cast<std::int64_t>(reads.slots.size());
              take(reads);
            });
}

void ReadDelivery::tell(Time stamp, const Unmade& unmade) {
  make(stamp, unmade, [&](const PaperReads& reads) {
    tell_together(unmade.antenna->parameters, stamp, *unmade.tags, reads);
  });
}

void ReadDelivery::tell(Time stamp, const Update& update) const {
  const AntennaInfo& antenna = *update.antenna;
  if (update.X_PA) {
    for (const auto& listener : outlets_.poses) {
      listener->on_pose(antenna, {stamp, antenna.name, *update.X_PA});
    }
  }
  for (const auto& listener : outlets_.truth) {
    listener->on_antenna_pose(antenna, {stamp, antenna.name, update.X_WA});
  }
  for (const auto& listener : outlets_.reads) listener->on_update(antenna, stamp);
}

void ReadDelivery::tell(Time /*stamp*/, const Place& place) const {
  for (const auto& listener : outlets_.truth) {
    if (place.label) {
      listener->on_tag_added(place.tag, *place.label);
    } else {
      listener->on_tag_moved(place.tag);
    }
  }
}

void ReadDelivery::tell(Time /*stamp*/, const Removed& removed) const {
  for (const auto& listener : outlets_.truth) listener->on_tag_removed(removed.tag);
}

void ReadDelivery::tell(Time stamp, const Placed& /*placed*/) const {
  for (const auto& listener : outlets_.truth) listener->on_tags_placed(stamp);
}

void ReadDelivery::tell(Time /*stamp*/, const AntennaPose& robot) const {
  for (const auto& listener : outlets_.truth) listener->on_robot_pose(robot);
}

bool ReadDelivery::is_kept(const Event& event, Time until) {
  const bool is_read = std::holds_alternative<Read>(event.what) ||
                       std::holds_alternative<Reads>(event.what) ||
                       std::holds_alternative<Unmade>(event.what);
  return is_read && event.stamp > until;
}

/// Resolves the tags' IDs now, because their slots may belong to other tags by then.
void ReadDelivery::keep(Event& event, std::vector<Event>& kept) {
  const auto keep_one = [&](const FieldAntenna& antenna, const TagPopulation& tags,
                            const TagReply& reply) {
    const TagRead read = to_read(antenna.parameters, tags.id(reply.slot), reply);
    kept.push_back({event.stamp, Read{read, reply.distance_m}});
  };
  if (const auto* const reads = std::get_if<Reads>(&event.what)) {
    for (const TagReply& reply : reads->replies) keep_one(*reads->antenna, *reads->tags, reply);
  } else if (const auto* const unmade = std::get_if<Unmade>(&event.what)) {
    make(event.stamp, *unmade, [&](const PaperReads& some) {
      for (std::size_t i = 0; i < some.slots.size(); ++i) {
        keep_one(*unmade->antenna, *unmade->tags, to_reply(some, i, event.stamp));
      }
    });
  } else {
    kept.push_back(std::move(event));
  }
}

std::vector<TagRead> ReadDelivery::kept_reads(const std::string& reader) const {
  std::vector<TagRead> all;
  for (const Event& event : events_) {
    const auto* const kept = std::get_if<Read>(&event.what);
    if (kept != nullptr && kept->read.reader == reader) all.push_back(kept->read);
  }
  return all;
}

void ReadDelivery::tell(Time until) {
  const auto earlier = [](const Event& a, const Event& b) { return a.stamp < b.stamp; };
  // Stable, so that events with equal stamps are delivered in the order in which they were added.
  if (!is_sorted_) std::stable_sort(events_.begin(), events_.end(), earlier);
  is_sorted_ = true;
  std::vector<Event> due;
  std::vector<Event> kept;
  for (Event& event : events_) {
    if (is_kept(event, until)) {
      keep(event, kept);
    } else {
      due.push_back(std::move(event));
    }
  }
  // Removed before delivery, so that nothing is delivered twice if a listener throws.
  events_ = std::move(kept);
  for (Event& event : due) {
    std::visit([&](const auto& what) { tell(event.stamp, what); }, event.what);
    auto* const reads = std::get_if<Reads>(&event.what);
    if (reads == nullptr) continue;
    reads->replies.clear();
    spare_.push_back(std::move(reads->replies));
  }
}

}  // namespace tagfield
