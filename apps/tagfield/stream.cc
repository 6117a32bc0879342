// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstring>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/middleware_arguments.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/speed_option.h"
#include "apps/tagfield/start_time.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/files/read_json.h"
#include "tagfield/scenario/late_tags.h"

namespace tagfield {
namespace {

struct StreamArguments {
  ScenarioArguments scenario;
  std::optional<double> speed;
  std::string start;
  MiddlewareArguments middleware;
  int threads = default_threads();
  bool as_json = false;  ///< Without effect.
};

/// Thrown when the reader of standard output has closed it: there is nothing more to do.
struct OutputClosed {};

/// Prints each read as a line of JSON on standard output.
class LinePrinter final : public ReadListener {
 public:
  explicit LinePrinter(Time start) : start_(start) {}

  void on_antenna_added(const AntennaInfo& antenna) override {
    ports_.port_of(antenna.reader, antenna.name);
  }
  void on_read(const TagRead& read) override {
    append_json(read, start_, ports_, lines_);
    lines_ += '\n';
    if (lines_.size() > kMaxBytes) flush();
  }
  void on_update(const AntennaInfo& /*antenna*/, Time /*stamp*/) override { flush(); }

  /// Writes all complete lines.
  void flush() {
    for (std::size_t done = 0; done < lines_.size();) {
      const ssize_t written = ::write(STDOUT_FILENO, lines_.data() + done, lines_.size() - done);
      if (written >= 0) {
        done += static_cast<std::size_t>(written);
      } else if (errno == EPIPE) {
        throw OutputClosed{};
      } else if (errno != EINTR) {
        throw Error(fmt::format("the standard output can't be written: {}", std::strerror(errno)));
      }
    }
    lines_.clear();
  }

 private:
  static constexpr std::size_t kMaxBytes = 1U << 16U;
  Time start_;
  AntennaPorts ports_;
  std::string lines_;
};

int stream(const StreamArguments& arguments) {
  Diagnostics diagnostics;
  const std::optional<EventsSpec> spec = events_spec_of(arguments.middleware);
  ScenarioWithWorld loaded = load(arguments.scenario, diagnostics);
  Scenario& scenario = loaded.scenario;
  if (arguments.speed) scenario.real_time = *arguments.speed;
  if (!arguments.speed && scenario.real_time == 0.0) scenario.real_time = 1.0;
  std::optional<NavigationWorld> world;
  if (scenario.pose.source == PoseSource::kSlam) {
    world = navigation_world(scenario, loaded.scene, diagnostics);
  }
  if (spec) warn_of_missing_readers(arguments.middleware.spec, *spec, scenario, diagnostics);
  check_topics(arguments.middleware, scenario, diagnostics);
  if (scenario.duration_s) {
    warn_of_late_tags(scenario, *scenario.duration_s, diagnostics);
    warn_of_late_kidnappings(scenario, *scenario.duration_s, diagnostics);
  }
  print_warnings(diagnostics);
  const Time start = start_time("stream", arguments.start, Time{});
  const auto lines = std::make_shared<LinePrinter>(start);
  RunControl control;
  const MiddlewareRun middleware =
      attach_middleware(arguments.middleware, spec, start, control.outlets);
  attach(lines, control.outlets);
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.keeps_recording = false;
  catch_interrupts();
  std::signal(SIGPIPE, SIG_IGN);
  try {
    const SeedRun run = simulate(scenario, arguments.scenario.seed.value_or(scenario.seed), control,
                                 world ? &*world : nullptr);
    lines->flush();
    const bool is_whole = finish(middleware, time_from_seconds(run.simulated_s));
    if (!run.complete) return kExitInterrupted;
    return is_whole ? kExitOk : kExitBadInput;
  } catch (const OutputClosed&) {
    return kExitOk;
  }
}

}  // namespace

void add_stream_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<StreamArguments>();
  CLI::App* command = app.add_subcommand(
      "stream", "Simulate a scenario and print each read as a line of JSON, as it comes");
  add_scenario_options(*command, arguments->scenario);
  add_speed_option(*command, arguments->speed, "what the scenario says by real_time, or else 1");
  add_start_option(*command, arguments->start);
  add_middleware_options(*command, arguments->middleware);
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  add_json_option(*command, arguments->as_json, "a line for each read, as without this option");
  command->footer(
      "A line has timestamp, reader, antennaPort, antennaName, epc, epcHex (where the tag's ID "
      "has\n"
      "bits), peakRssiCdbm [dBm/100], phaseAngle [deg] and frequency [kHz]. It ends with the\n"
      "scenario, by Ctrl-C, or when the program that reads the lines ends:\n"
      "  tagfield stream scenarios/conveyor.yaml --speed 0 | head -n 3");
  command->callback([arguments, &chosen] { chosen = [arguments] { return stream(*arguments); }; });
}

}  // namespace tagfield
