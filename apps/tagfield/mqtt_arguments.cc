#include "apps/tagfield/mqtt_arguments.h"

#include <fmt/format.h>

#include <vector>

#include "apps/tagfield/command_line.h"
#include "tagfield/events/event_stage.h"
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

std::shared_ptr<MqttOutlet> attach_mqtt(const MqttArguments& arguments, Time start,
                                        Outlets& outlets) {
  if (arguments.url.empty()) return nullptr;
  MqttOptions options;
  options.most_messages = arguments.buffer;
  options.warn = [](const std::string& line) {
    fmt::print(stderr, "tagfield: warning: {}\n", line);
  };
  auto mqtt = std::make_shared<MqttOutlet>(arguments.url, start, options);
  attach(mqtt, outlets);
  if (!arguments.spec.empty()) {
    attach(std::make_shared<EventStage>(read_events_spec(arguments.spec),
                                        std::vector<std::shared_ptr<EventListener>>{mqtt}),
           outlets);
  }
  return mqtt;
}

void finish(MqttOutlet* mqtt) {
  if (mqtt == nullptr) return;
  mqtt->finish(interrupted() ? kMomentAfterInterrupt : MqttOptions{}.patience);
}

}  // namespace tagfield
