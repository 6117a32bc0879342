// SPDX-License-Identifier: Apache-2.0
// Replaces mqtt_client.cc in builds without libmosquitto.
#include "adapters/mqtt/mqtt_client.h"
#include "tagfield/base/error.h"

namespace tagfield {

class MqttClient::Impl {};

MqttClient::MqttClient(const MqttUrl& /*url*/, const MqttOptions& /*options*/) {
  throw Error("MQTT: this tagfield was built without libmosquitto (libmosquitto-dev)");
}

MqttClient::~MqttClient() = default;

void MqttClient::publish(const std::string& /*topic*/, const std::string& /*payload*/) {}

void MqttClient::finish(std::chrono::milliseconds /*patience*/) {}

MqttCounts MqttClient::counts() const { return {}; }

}  // namespace tagfield
