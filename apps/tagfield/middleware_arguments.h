// SPDX-License-Identifier: Apache-2.0
/// @file
/// Middleware that gets what a scenario yields: a broker of MQTT, a repository of EPCIS.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "adapters/epcis/capture_client.h"
#include "adapters/mqtt/mqtt_outlet.h"
#include "tagfield/events/event_stage.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// A repository of EPCIS that captures events.
struct CaptureArguments {
  std::string url;  ///< "" for none.
  std::vector<std::string> headers;
  /// Events that are kept while it is away or slow.
  std::size_t buffer = CaptureOptions{}.most_events;
};

/// Adds --capture and --capture-header.
void add_capture_options(CLI::App& command, CaptureArguments& arguments);

/// Null where none is asked for. It warns on standard error.
std::shared_ptr<CaptureClient> capture_client(const CaptureArguments& arguments);

struct MiddlewareArguments {
  std::string broker;  ///< URL; "" for none.
  std::size_t buffer = MqttOptions{}.most_messages;
  CaptureArguments capture;
  std::string spec;  ///< File of events to be told; "" for none.
};

/// Adds --mqtt, --mqtt-buffer, --capture, --capture-header and --spec.
void add_middleware_options(CLI::App& command, MiddlewareArguments& arguments);

/// Null what is not asked for.
struct MiddlewareRun {
  std::shared_ptr<MqttOutlet> broker;      ///< Gets reads, and events where a spec says which.
  std::shared_ptr<CaptureClient> capture;  ///< Gets events of EPCIS.
  std::shared_ptr<EventStage> events;
};

/// Times are `start`, since 1970, plus stamps.
MiddlewareRun attach_middleware(const MiddlewareArguments& arguments, Time start, Outlets& outlets);

/// The run ends at `end`: what that makes of events is told, and what has not got through yet is
/// waited for, after Ctrl-C a moment only. False if some of it was lost or refused, of which a
/// warning has told.
bool finish(const MiddlewareRun& run, Time end);

}  // namespace tagfield
