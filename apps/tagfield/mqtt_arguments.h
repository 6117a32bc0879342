/// @file
/// A broker of MQTT that gets what a scenario yields.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "adapters/mqtt/mqtt_outlet.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

struct MqttArguments {
  std::string url;  ///< "" for no broker.
  std::size_t buffer = MqttOptions{}.most_messages;
  std::string spec;  ///< File of events to be told, too; "" for none.
};

/// Adds --mqtt, --mqtt-buffer and --spec.
void add_mqtt_options(CLI::App& command, MqttArguments& arguments);

/// A broker that gets reads, and events where they are asked for; null for none. Times are `start`,
/// since 1970, plus stamps.
std::shared_ptr<MqttOutlet> attach_mqtt(const MqttArguments& arguments, Time start,
                                        Outlets& outlets);

/// What has not got through yet is waited for, after Ctrl-C a moment only.
void finish(MqttOutlet* mqtt);

}  // namespace tagfield
