// SPDX-License-Identifier: Apache-2.0
/// @file
/// Makes events of reads: a middleware's filtering and collecting, as an outlet.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/events/event_listener.h"
#include "tagfield/events/events_spec.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// Turns reads into events. What is asked for is told in order of time.
class EventStage final : public ReadListener {
 public:
  /// All of `listeners` are told, in this order.
  EventStage(EventsSpec spec, std::vector<std::shared_ptr<EventListener>> listeners);
  ~EventStage() override;

  void on_read(const TagRead& read) override;
  /// Of antennas that update and read nothing, time is known by their updates: reads from before
  /// the last but one have all been told.
  void on_update(const AntennaInfo& antenna, Time stamp) override;
  void on_antenna_removed(const std::string& name) override;
  /// What was there is forgotten, and nothing told of it.
  void on_restart() override;

  /// No read before `now` will come: what is due by then is told.
  void advance(Time now);
  /// No read will come any more: what is due by `end` is told, and reports of cycles that go on.
  void finish(Time end);

  /// Tags that are observed and not gone, by logical reader and ID: each as it would be told now.
  [[nodiscard]] std::vector<PresenceEvent> present() const;

  /// Antennas and readers that logical readers name and nothing was read of, each as
  /// "antenna 'left' of logical reader 'gate'".
  [[nodiscard]] std::vector<std::string> unheard() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
