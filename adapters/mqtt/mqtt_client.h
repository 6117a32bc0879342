// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sends messages to an MQTT broker, each at least once, across failures of the broker.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>

#include "adapters/mqtt/mqtt_url.h"

namespace tagfield {

struct MqttOptions {
  /// Messages that are buffered while the broker is unreachable or slow. When the buffer is full,
  /// the oldest are dropped.
  std::size_t max_messages = 100'000;
  /// How long the destructor waits without any message being delivered.
  std::chrono::milliseconds patience{5000};
  /// Receives one line when the broker becomes unreachable, comes back or refuses messages, and
  /// when messages are lost. Called from any thread; must not call the client. Empty for no
  /// warnings.
  std::function<void(const std::string& line)> warn;
};

/// Messages by outcome.
struct MqttCounts {
  std::size_t taken = 0;      ///< Handed to the client.
  std::size_t delivered = 0;  ///< Acknowledged by the broker.
  std::size_t lost = 0;       ///< Dropped because the buffer was full or time ran out at the end.
};

/// Publishes with quality of service 1: messages that the broker has not acknowledged are sent
/// again after a reconnection, so they may arrive twice. Retries to connect after 1, 2, 4, … 30 s.
class MqttClient {
 public:
  /// Starts to connect, without waiting for it. Throws Error if the host is unknown, TLS is not
  /// built in, or Tagfield was built without libmosquitto.
  MqttClient(const MqttUrl& url, const MqttOptions& options);
  /// Calls finish() with MqttOptions::patience.
  ~MqttClient();
  MqttClient(const MqttClient&) = delete;
  MqttClient& operator=(const MqttClient&) = delete;

  /// Callable from any thread. Never waits for the network.
  void publish(const std::string& topic, const std::string& payload);
  /// Waits until the broker has acknowledged all messages. Gives up if none is acknowledged for
  /// `patience`, and counts the rest as lost. No more messages can be published after that.
  void finish(std::chrono::milliseconds patience);
  [[nodiscard]] MqttCounts counts() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
