// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which tags are present at one logical reader.
#pragma once

#include <deque>
#include <optional>
#include <queue>
#include <string>
#include <unordered_map>
#include <utility>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Turns reads into presence events, without filtering.
class Presence {
 public:
  Presence(std::string logical_reader, const PresenceRule& rule)
      : logical_reader_(std::move(logical_reader)), rule_(rule) {}

  /// The next time at which a tag may be gone; advance() must be called by then.
  [[nodiscard]] std::optional<Time> due() const;
  /// Advances time to `now`: all tags not read for the rule's time are gone.
  void advance(Time now, EventListener& listener);
  /// Takes a read no earlier than the previous ones; advance() must have been called with its
  /// timestamp.
  void take(const TagRead& read, EventListener& listener);

  /// Appends the observed tags, in no particular order.
  void append_present(std::vector<PresenceEvent>& all) const;

 private:
  struct Present {
    bool is_observed = false;
    std::deque<Time> recent;  ///< Reads within the rule's window, until it is observed.
    PresenceEvent event;      ///< As it would be reported.
  };
  using Due = std::pair<Time, std::string>;
  void tell(PresenceChange change, Time stamp, Present& tag, EventListener& listener) const;

  std::string logical_reader_;
  PresenceRule rule_;
  std::unordered_map<std::string, Present> tags_;
  /// One entry per tag, due no later than its time is over.
  std::priority_queue<Due, std::vector<Due>, std::greater<>> due_;
};

}  // namespace tagfield
