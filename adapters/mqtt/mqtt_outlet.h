// SPDX-License-Identifier: Apache-2.0
/// @file
/// Publishes reads and events to an MQTT broker.
#pragma once

#include <string>

#include "adapters/mqtt/mqtt_client.h"
#include "tagfield/base/time.h"
#include "tagfield/events/event_listener.h"
#include "tagfield/files/read_json.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// Publishes each read to PREFIX/reads/READER and each event to PREFIX/events, as JSON (see
/// append_json() and event_json.h), with quality of service 1. Never waits for the broker.
class MqttOutlet final : public ReadListener, public EventListener {
 public:
  /// `url`: as for mqtt_url(); times are `start`, since 1970, plus stamps. Throws Error as
  /// MqttClient does.
  MqttOutlet(const std::string& url, Time start, const MqttOptions& options);

  void on_antenna_added(const AntennaInfo& antenna) override;
  void on_read(const TagRead& read) override;
  void on_presence(const PresenceEvent& event) override;
  void on_cycle(const CycleReports& reports) override;

  /// See MqttClient::finish().
  void finish(std::chrono::milliseconds patience) { client_.finish(patience); }
  [[nodiscard]] MqttCounts counts() const { return client_.counts(); }

 private:
  void publish_event(std::string line);

  MqttUrl url_;
  Time start_;
  AntennaPorts ports_;
  MqttClient client_;
};

}  // namespace tagfield
