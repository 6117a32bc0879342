// SPDX-License-Identifier: Apache-2.0
/// @file
/// Messages to a broker of MQTT, each at least once, whatever the broker does meanwhile.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "adapters/mqtt/mqtt_url.h"

namespace tagfield {

struct MqttOptions {
  /// Messages that are kept while the broker is away or slow. Of more the oldest are lost.
  std::size_t most_messages = 100'000;
  /// How long the end waits while no message gets through.
  std::chrono::milliseconds patience{5000};
  /// Gets a line where the broker goes, comes back or refuses, and where messages are lost. Called
  /// from any thread; it must not call the client. Empty for silence.
  std::function<void(const std::string& line)> warn;
};

/// What became of messages.
struct MqttCounts {
  std::size_t taken = 0;      ///< Handed to the client.
  std::size_t delivered = 0;  ///< The broker said that it has them.
  std::size_t lost = 0;       ///< There was no room for them.
};

/// Publishes with quality of service 1: what the broker has not acknowledged is sent again after a
/// reconnection, so that it may come twice. Tries to reconnect after 1, 2, 4, … 30 s.
class MqttClient {
 public:
  /// Begins to connect, and doesn't wait for it. Throws Error where the host is not known, TLS
  /// is not built in, or Tagfield was built without libmosquitto.
  MqttClient(const MqttUrl& url, const MqttOptions& options);
  /// finish()es, with MqttOptions::patience.
  ~MqttClient();
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  /// From any thread. Never waits for the network.
  void publish(const std::string& topic, const std::string& payload);
  /// Waits until the broker has all, or gives up once no message got through for so long, and
  /// counts the rest as lost. Then nothing more can be published.
  void finish(std::chrono::milliseconds patience);
  [[nodiscard]] MqttCounts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
