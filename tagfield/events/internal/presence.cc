// SPDX-License-Identifier: Apache-2.0
#include "tagfield/events/internal/presence.h"

#include <algorithm>

namespace tagfield {

std::optional<Time> Presence::due() const {
  return due_.empty() ? std::nullopt : std::optional(due_.top().first);
}

void Presence::advance(Time now, EventListener& listener) {
  while (!due_.empty() && due_.top().first <= now) {
    const auto [due, id] = due_.top();
    due_.pop();
    const auto tag = tags_.find(id);
    const Time over = tag->second.event.last_read + rule_.gone_after;
    if (over > due) {
      due_.emplace(over, id);
      continue;
    }
    // A tag that was only glimpsed was never present, so it cannot be gone.
    if (tag->second.is_observed) tell(PresenceChange::kGone, over, tag->second, listener);
    tags_.erase(tag);
  }
}

void Presence::take(const TagRead& read, EventListener& listener) {
  const auto [place, is_new] = tags_.try_emplace(read.tag);
  Present& tag = place->second;
  PresenceEvent& event = tag.event;
  if (is_new) {
    event.logical_reader = logical_reader_;
    event.tag = read.tag;
    event.first_read = read.stamp;
    event.max_rssi_dbm = read.rssi_dbm;
    due_.emplace(read.stamp + rule_.gone_after, read.tag);
  }
  event.antenna = read.antenna;
  event.last_read = read.stamp;
  event.max_rssi_dbm = std::max(event.max_rssi_dbm, read.rssi_dbm);
  ++event.reads;
  if (is_new) tell(PresenceChange::kGlimpsed, read.stamp, tag, listener);
  if (tag.is_observed) return;
  tag.recent.push_back(read.stamp);
  while (read.stamp - tag.recent.front() > rule_.within) tag.recent.pop_front();
  if (tag.recent.size() < rule_.reads) return;
  tag.is_observed = true;
  tag.recent = {};
  tell(PresenceChange::kObserved, read.stamp, tag, listener);
}

void Presence::append_present(std::vector<PresenceEvent>& all) const {
  for (const auto& [id, tag] : tags_) {
    if (tag.is_observed) all.push_back(tag.event);
  }
}

void Presence::tell(PresenceChange change, Time stamp, Present& tag,
                    EventListener& listener) const {
  tag.event.change = change;
  tag.event.stamp = stamp;
  listener.on_presence(tag.event);
}

}  // namespace tagfield
