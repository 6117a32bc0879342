#include "apps/tagfield/mqtt_arguments.h"

#include <fmt/format.h>

#include <vector>

#include "apps/tagfield/command_line.h"
#include "tagfield/events/events_yaml.h"

namespace tagfield {
namespace {

constexpr std::chrono::milliseconds kMomentAfterInterrupt(300);

}  // namespace

void add_mqtt_options(CLI::App& command, MqttArguments& arguments) {
  CLI::Option* mqtt = command.add_option(
      "--mqtt", arguments.url,
      "Publish each read to this broker, too: mqtt://[user:password@]host[:port][/prefix], to "
      "PREFIX/reads/READER (docs/events.md)");
  command
      .add_option("--mqtt-buffer", arguments.buffer,
                  "Messages that are kept while the broker is away (default 100000)")
      ->check(CLI::Range(std::size_t{1}, std::size_t{100'000'000}))
      ->needs(mqtt);
  command
      .add_option("--spec", arguments.spec,
                  "Publish events, too, to PREFIX/events: as this file says, see 'tagfield events'")
      ->needs(mqtt);
}

MqttRun attach_mqtt(const MqttArguments& arguments, Time start, Outlets& outlets) {
  MqttRun run;
  if (arguments.url.empty()) return run;
  MqttOptions options;
  options.most_messages = arguments.buffer;
  options.warn = [](const std::string& line) {
    fmt::print(stderr, "tagfield: warning: {}\n", line);
  };
  run.broker = std::make_shared<MqttOutlet>(arguments.url, start, options);
  attach(run.broker, outlets);
  if (arguments.spec.empty()) return run;
  run.events = std::make_shared<EventStage>(
      read_events_spec(arguments.spec), std::vector<std::shared_ptr<EventListener>>{run.broker});
  attach(run.events, outlets);
  return run;
}

void finish(const MqttRun& run, Time end) {
  if (run.events) run.events->finish(end);
  if (!run.broker) return;
  run.broker->finish(interrupted() ? kMomentAfterInterrupt : MqttOptions{}.patience);
}

}  // namespace tagfield
