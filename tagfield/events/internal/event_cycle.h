// SPDX-License-Identifier: Apache-2.0
/// @file
/// A repeating event cycle.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"

namespace tagfield {

/// Collects tags and makes reports of them.
class EventCycle {
 public:
  explicit EventCycle(const CycleSpec& spec);

  [[nodiscard]] const CycleSpec& spec() const { return spec_; }
  /// The next time at which a cycle begins or ends; none before the first advance().
  [[nodiscard]] std::optional<Time> due() const;
  /// Advances time to `now`: begins and ends the cycles that are due. The first call starts
  /// listening: earlier cycles of a period are counted but not reported, and without a period none
  /// begins before `now`. No tags will be taken before `horizon`, which is not before `now`.
  void advance(Time now, Time horizon, EventListener& listener);
  /// Takes a tag that was read; advance() must have been called with the read's timestamp.
  void take(Time stamp, const std::string& id, const EpcToMatch& tag);
  /// Ends the reads: cuts off the cycle in progress at `now`, without reporting deletions.
  void finish(Time now, EventListener& listener);

 private:
  using Tags = std::map<std::string, EpcToMatch>;
  void begin_at_first(Time now);
  void skip_idle(Time horizon);
  void begin(Time at);
  void end(Time at, CycleEnd why, EventListener& listener);
  [[nodiscard]] std::optional<Duration> period() const;
  [[nodiscard]] std::pair<Time, CycleEnd> end_due() const;
  [[nodiscard]] std::optional<CycleReport> report(std::size_t index);

  CycleSpec spec_;
  bool is_first_ = true;
  bool goes_on_ = false;
  std::optional<Time> next_;  ///< When the next cycle begins, if none is in progress.
  std::size_t number_ = 0;
  Time begin_;
  Time newest_;  ///< When the last new tag was read.
  Tags tags_;
  std::vector<Tags> before_;  ///< For each report, the tags of the previous cycle.
};

}  // namespace tagfield
