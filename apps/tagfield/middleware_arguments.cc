// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/middleware_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <vector>

#include "adapters/mqtt/mqtt_url.h"
#include "apps/tagfield/command_line.h"
#include "tagfield/base/spelling.h"
#include "tagfield/events/epcis.h"
#include "tagfield/events/events_yaml.h"

namespace tagfield {
namespace {

constexpr std::chrono::milliseconds kMomentAfterInterrupt(300);
/// Longer than the time limit of a request.
constexpr std::chrono::milliseconds kCapturePatience(35'000);

void report_warning(const std::string& line) {
  fmt::print(stderr, "tagfield: warning: {}\n", line);
}

std::shared_ptr<MqttOutlet> broker_of(const MiddlewareArguments& arguments, Time start) {
  if (arguments.broker.empty()) return nullptr;
  MqttOptions options;
  options.max_messages = arguments.buffer;
  options.warn = report_warning;
  return std::make_shared<MqttOutlet>(arguments.broker, start, options);
}

}  // namespace

void add_capture_options(CLI::App& command, CaptureArguments& arguments) {
  CLI::Option* capture = command.add_option(
      "--capture", arguments.url,
      "Post ObjectEvents of EPCIS 2.0 to this repository: the address of its capture interface, "
      "http[s]://[user:password@]host[:port]/path (docs/events.md)");
  command
      .add_option(
          "--capture-header", arguments.headers,
          "Additional header of those requests, 'Name: value', such as an API key; can be repeated")
      ->needs(capture);
}

std::shared_ptr<CaptureClient> capture_client(const CaptureArguments& arguments) {
  if (arguments.url.empty()) return nullptr;
  CaptureOptions options;
  options.headers = arguments.headers;
  options.max_events = arguments.buffer;
  options.warn = report_warning;
  return std::make_shared<CaptureClient>(arguments.url, options);
}

void add_middleware_options(CLI::App& command, MiddlewareArguments& arguments) {
  CLI::Option* mqtt = command.add_option(
      "--mqtt", arguments.broker,
      "Also publish each read to this broker: mqtt://[user:password@]host[:port][/prefix], to "
      "PREFIX/reads/READER (docs/events.md)");
  command
      .add_option("--mqtt-buffer", arguments.buffer,
                  "Messages that are kept while the broker can't be reached (default 100000)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->needs(mqtt);
  add_capture_options(command, arguments.capture);
  command.add_option("--spec", arguments.spec,
                     "File (YAML) that defines events, as for 'tagfield events': with --mqtt they "
                     "are also published to PREFIX/events, with --capture they are posted");
}

std::optional<EventsSpec> events_spec_of(const MiddlewareArguments& arguments) {
  if (arguments.spec.empty()) return std::nullopt;
  if (arguments.broker.empty() && arguments.capture.url.empty()) {
    throw Error("--spec requires --mqtt or --capture, where events go to");
  }
  return read_events_spec(arguments.spec);
}

void warn_of_missing_readers(const std::string& file, const EventsSpec& spec,
                             const Scenario& scenario, Diagnostics& diagnostics) {
  std::vector<std::string> antennas;
  std::vector<std::string> readers;
  for (const AntennaSpec& antenna : scenario.antennas) {
    antennas.push_back(antenna.parameters.name);
    readers.push_back(antenna.parameters.reader);
  }
  for (const LogicalReader& logical : spec.logical_readers) {
    const auto warn_unless_among = [&](const std::vector<std::string>& known,
                                       const std::string& name, const char* what) {
      if (std::find(known.begin(), known.end(), name) != known.end()) return;
      diagnostics.warn(Location{file, 0},
                       fmt::format("the scenario has no {} '{}', which logical reader '{}' names{}",
                                   what, name, logical.name, suggestion(name, known)));
    };
    for (const std::string& name : logical.antennas) warn_unless_among(antennas, name, "antenna");
    for (const std::string& name : logical.readers) warn_unless_among(readers, name, "reader");
  }
}

void check_topics(const MiddlewareArguments& arguments, const Scenario& scenario,
                  Diagnostics& diagnostics) {
  if (arguments.broker.empty()) return;
  std::set<std::string> readers;
  for (const AntennaSpec& antenna : scenario.antennas) readers.insert(antenna.parameters.reader);
  check_reader_topics(readers, diagnostics);
}

MiddlewareRun attach_middleware(const MiddlewareArguments& arguments,
                                const std::optional<EventsSpec>& spec, Time start,
                                Outlets& outlets) {
  MiddlewareRun run;
  const EventsSpec events = spec.value_or(EventsSpec{});
  std::vector<std::shared_ptr<EventListener>> listeners;
  run.broker = broker_of(arguments, start);
  if (run.broker) attach(run.broker, outlets);
  if (run.broker && spec) listeners.push_back(run.broker);
  run.capture = capture_client(arguments.capture);
  if (run.capture) {
    listeners.push_back(std::make_shared<EpcisEvents>(
        events, start, false,
        [capture = run.capture](const std::string& event) { capture->capture(event); }));
  }
  if (listeners.empty()) return run;
  run.events = std::make_shared<EventStage>(events, listeners);
  attach(run.events, outlets);
  return run;
}

bool finish(const MiddlewareRun& run, Time end) {
  bool is_whole = true;
  if (run.events) run.events->finish(end);
  if (run.broker) {
    run.broker->finish(interrupted() ? kMomentAfterInterrupt : MqttOptions{}.patience);
    const MqttCounts counts = run.broker->counts();
    is_whole = counts.delivered == counts.taken;
  }
  if (run.capture) {
    // Ctrl-C may also be pressed while waiting.
    const bool was_interrupted = interrupted();
    run.capture->finish(was_interrupted ? kMomentAfterInterrupt : kCapturePatience,
                        [was_interrupted] { return !was_interrupted && interrupted(); });
    const CaptureCounts counts = run.capture->counts();
    is_whole = is_whole && counts.captured == counts.taken;
  }
  return is_whole;
}

}  // namespace tagfield
