// SPDX-License-Identifier: Apache-2.0
/// @file
/// One event cycle, again and again.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"

namespace tagfield {

/// Gathers tags and makes reports of them.
class EventCycle {
 public:
  explicit EventCycle(const CycleSpec& spec);

  [[nodiscard]] const CycleSpec& spec() const { return spec_; }
  /// The next time at which a cycle begins or ends; none before the first advance().
  [[nodiscard]] std::optional<Time> due() const;
  /// Time is `now`: what is due by then begins and ends. The first call tells when there is
  /// somebody to listen: a cycle that would have begun earlier begins then, with its place in the
  /// order of cycles. Nothing will be taken before `horizon`, which is not before `now`.
  void advance(Time now, Time horizon, EventListener& listener);
  /// A tag was read, advance() having been called with the read's stamp.
  void take(Time stamp, const std::string& id, const EpcToMatch& tag);
  /// There will be no more reads: the cycle that goes on is cut off at `now`, and
  /// tells no deletions.
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
  std::optional<Time> next_;  ///< When the next begins, where none goes on.
  std::size_t number_ = 0;
  Time begin_;
  Time newest_;  ///< When the last new tag came.
  Tags tags_;
  std::vector<Tags> before_;  ///< Of each report, the tags of the cycle before.
};

}  // namespace tagfield
