/// @file
/// A broker of MQTT that gets what a scenario yields.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "adapters/mqtt/mqtt_outlet.h"
#include "tagfield/events/event_stage.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

struct MqttArguments {
  std::string url;  ///< "" for no broker.
  std::size_t buffer = MqttOptions{}.most_messages;
  std::string spec;  ///< File of events to be told, too; "" for none.
};

/// Adds --mqtt, --mqtt-buffer and --spec.
void add_mqtt_options(CLI::App& command, MqttArguments& arguments);

/// A broker that gets reads, and events where they are asked for; both null where nothing is.
struct MqttRun {
  std::shared_ptr<MqttOutlet> broker;
  std::shared_ptr<EventStage> events;
};

/// Times are `start`, since 1970, plus stamps.
MqttRun attach_mqtt(const MqttArguments& arguments, Time start, Outlets& outlets);

/// The run ends at `end`: what that makes of events is told, and what has not got through yet is
/// waited for, after Ctrl-C a moment only.
void finish(const MqttRun& run, Time end);

}  // namespace tagfield
