// SPDX-License-Identifier: Apache-2.0
/// @file
/// Turns reads into events: the filtering and collection of a middleware, as an outlet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// Turns reads into the requested events, in chronological order.
class EventStage final : public ReadListener {
 public:
  /// All `listeners` are notified, in this order.
  EventStage(EventsSpec spec, std::vector<std::shared_ptr<EventListener>> listeners);
  ~EventStage() override;

  void on_read(const TagRead& read) override;
  /// Advances time by the updates of antennas, even those that read nothing: all reads older than
  /// an antenna's last update but one have been received.
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_removed(const std::string& name) override;
  /// Forgets all tags without notifying of any.
  void on_restart() override;

  /// Emits what is due by `now`; no read before `now` may follow.
  void advance(Time now);
  /// Emits what is due by `end`, and reports of cycles in progress; no reads may follow.
  void finish(Time end);

  /// Tags that are observed and not gone, sorted by logical reader and ID, each as it would be
  /// reported now.
  [[nodiscard]] std::vector<PresenceEvent> present() const;

  /// Antennas and readers that logical readers name but that have read nothing, each as "antenna
  /// 'left' of logical reader 'gate'".
  [[nodiscard]] std::vector<std::string> unheard() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
