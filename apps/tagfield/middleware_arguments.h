// SPDX-License-Identifier: Apache-2.0
/// @file
/// Middleware that receives a scenario's output: an MQTT broker, an EPCIS repository.
#pragma once

#include <CLI/CLI.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "adapters/epcis/capture_client.h"
#include "adapters/mqtt/mqtt_outlet.h"
#include "tagfield/events/event_stage.h"
#include "tagfield/events/events_spec.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/stream/listeners.h"

namespace tagfield {

/// An EPCIS repository that captures events.
struct CaptureArguments {
  std::string url;  ///< "" for none.
  std::vector<std::string> headers;
  /// Events that are buffered while it is unreachable or slow.
  std::size_t buffer = CaptureOptions{}.max_events;
};

/// Adds --capture and --capture-header.
void add_capture_options(CLI::App& command, CaptureArguments& arguments);

/// The client, or null if none is requested. It warns on standard error.
std::shared_ptr<CaptureClient> capture_client(const CaptureArguments& arguments);

struct MiddlewareArguments {
  std::string broker;  ///< URL; "" for none.
  std::size_t buffer = MqttOptions{}.max_messages;
  CaptureArguments capture;
  std::string spec;  ///< File that specifies events; "" for none.
};

/// Adds --mqtt, --mqtt-buffer, --capture, --capture-header and --spec.
void add_middleware_options(CLI::App& command, MiddlewareArguments& arguments);

/// Null if not requested.
struct MiddlewareRun {
  std::shared_ptr<MqttOutlet> broker;      ///< Receives reads, and events if there is a spec.
  std::shared_ptr<CaptureClient> capture;  ///< Receives EPCIS events.
  std::shared_ptr<EventStage> events;
};

/// The events of --spec, if it is given; the file may be a pipe and is read only once. Throws Error
/// as read_events_spec() does, and if nothing receives events.
std::optional<EventsSpec> events_spec_of(const MiddlewareArguments& arguments);

/// Warns of antennas and readers of the spec, from this file, that the scenario does not have.
void warn_of_missing_readers(const std::string& file, const EventsSpec& spec,
                             const Scenario& scenario, Diagnostics& diagnostics);

/// With --mqtt, see check_reader_topics().
void check_topics(const MiddlewareArguments& arguments, const Scenario& scenario,
                  Diagnostics& diagnostics);

/// `spec`: see events_spec_of(). Times are `start`, since 1970, plus stamps.
MiddlewareRun attach_middleware(const MiddlewareArguments& arguments,
                                const std::optional<EventsSpec>& spec, Time start,
                                Outlets& outlets);

/// Finishes the run at `end`: reports the events that result, and waits for pending deliveries,
/// after Ctrl-C only for a moment. False if some were lost or refused, which a warning has
/// reported.
bool finish(const MiddlewareRun& run, Time end);

}  // namespace tagfield
