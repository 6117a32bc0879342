// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <optional>

#include "adapters/http/admission.h"
#include "adapters/http/embedded.h"
#include "adapters/http/http_server.h"
#include "adapters/http/laser_view.h"
#include "adapters/llrp/llrp_server.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_line.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/middleware_arguments.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/speed_option.h"
#include "apps/tagfield/start_time.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/live/live_estimates.h"
#include "tagfield/planning/moment.h"
#include "tagfield/report/plan_layer.h"

namespace tagfield {
namespace {

struct ServeArguments {
  ScenarioArguments of_scenario;
  std::optional<std::uint16_t> http;
  std::optional<std::uint16_t> llrp;
  std::string start;
  MiddlewareArguments middleware;
  bool locates = false;
  std::string method;  ///< Empty for the scenario's.
  double window_s = 120.0;
  std::string plan;  ///< Folder; "" for the scenario's, if that is a plan's layout.
  std::string listen = "127.0.0.1";
  std::string token;
  std::optional<double> speed;
  bool is_paused = false;
  bool as_json = false;
};

bool is_loopback(const std::string& address) {
  return address == "::1" || address.rfind("127.", 0) == 0;
}

/// Requires a token if other machines can reach the server.
void require_token(ServeArguments& arguments) {
  if (is_loopback(arguments.listen)) return;
  if (arguments.token.empty()) arguments.token = http::new_token();
  fmt::print(stderr,
             "tagfield: warning: others can reach {} and look at this world; commands need the "
             "token {}\n",
             arguments.listen, arguments.token);
}

void warn(const std::string& line) { fmt::print(stderr, "tagfield: warning: {}\n", line); }

std::shared_ptr<llrp::LlrpServer> llrp_server(const ServeArguments& arguments) {
  if (!arguments.llrp) return nullptr;
  llrp::LlrpOptions options;
  options.address = arguments.listen;
  options.port = *arguments.llrp;
  options.epoch_us = std::chrono::duration_cast<std::chrono::microseconds>(
                         start_time("serve", arguments.start, Time{}).time_since_epoch())
                         .count();
  options.warn = warn;
  return std::make_shared<llrp::LlrpServer>(options);
}

/// Advances the time of events when there are no reads.
class EventClock final : public LiveMember {
 public:
  explicit EventClock(std::shared_ptr<EventStage> events) : events_(std::move(events)) {}
  void on_step(LiveWorld& world, Time now) override {
    // Reads may be delayed until the next update of the slowest antenna.
    double slowest_hz = 1.0;
    for (const LiveAntenna& antenna : world.antennas()) {
      slowest_hz = std::min(slowest_hz, antenna.spec.parameters.rate_hz);
    }
    events_->advance(now - duration_from_seconds(2.0 / slowest_hz));
  }

 private:
  std::shared_ptr<EventStage> events_;
};

/// Closes the connections before the world is destroyed, even on exceptions.
class Closing {
 public:
  explicit Closing(llrp::LlrpServer* server) : server_(server) {}
  ~Closing() {
    if (server_ != nullptr) server_->close();
  }
  Closing(const Closing&) = delete;
  Closing& operator=(const Closing&) = delete;

 private:
  llrp::LlrpServer* server_;
};

std::shared_ptr<LiveEstimates> live_estimates(const ServeArguments& arguments,
                                              const Scenario& scenario) {
  if (!arguments.locates) return nullptr;
  LiveEstimateOptions options;
  options.localization = localization_options(scenario, 1);
  if (!arguments.method.empty()) options.localization.method = arguments.method;
  if (options.localization.method == kNoLocalization) {
    throw Error(
        fmt::format("serve: the scenario's localization is '{}': expected --method METHOD with "
                    "--locate",
                    kNoLocalization));
  }
  options.window = duration_from_seconds(arguments.window_s);
  return std::make_shared<LiveEstimates>(std::move(options));
}

/// Time for which shutdown waits for an estimate in progress.
constexpr std::chrono::milliseconds kPatience(300);

/// Ends the process, after all output, without waiting for an estimate that would take longer.
void end_estimates(LiveEstimates* estimates) {
  if (estimates == nullptr || estimates->stop(kPatience)) return;
  std::fflush(nullptr);
  std::_Exit(kExitOk);
}

/// The plan to show, as JSON; "" for none.
std::string plan_of(const ServeArguments& arguments, Diagnostics& diagnostics) {
  if (!arguments.plan.empty()) return plan_layer_to_json(arguments.plan);
  const std::filesystem::path scenario(arguments.of_scenario.scenario);
  const std::string folder = (scenario.has_parent_path() ? scenario.parent_path() : ".").string();
  if (scenario.filename() != "layout.yaml" || !is_plan_folder(folder)) return "";
  try {
    return plan_layer_to_json(folder);
  } catch (const Error& error) {
    diagnostics.warn(fmt::format("the plan beside the layout is not shown: {}", error.what()));
    return "";
  }
}

void print_addresses(const std::vector<llrp::LlrpAddress>& readers, const std::string& page,
                     bool as_json) {
  if (!page.empty() && http::page_file().empty()) {
    warn("there is no page at this address: tagfield was built without it (see tagfield doctor)");
  }
  if (as_json) {
    nlohmann::ordered_json all = {{"http", nullptr}, {"llrp", nlohmann::ordered_json::array()}};
    if (!page.empty()) all["http"] = page;
    for (const llrp::LlrpAddress& reader : readers) {
      all["llrp"].push_back(
          {{"reader", reader.reader}, {"address", reader.address}, {"port", reader.port}});
    }
    print_json_line(all);
  } else {
    for (const llrp::LlrpAddress& reader : readers) {
      fmt::print("llrp: {} at {} port {}\n", reader.reader, reader.address, reader.port);
    }
    if (!readers.empty()) fmt::print("Readers are silent until LLRP clients start them.\n");
    if (!page.empty()) fmt::print("http: {}\n", page);
  }
  flush_output();
}

LiveOptions live_options(const ServeArguments& arguments) {
  LiveOptions options;
  options.speed = arguments.speed.value_or(1.0);
  options.is_paused = arguments.is_paused;
  options.threads = default_threads();
  // Readers controlled by LLRP clients start on request.
  options.readers_start = !arguments.llrp;
  return options;
}

int serve(ServeArguments arguments) {
  const auto feed = std::make_shared<http::LiveFeed>(start_time("serve", arguments.start, Time{}));
  const auto llrp = llrp_server(arguments);
  Diagnostics diagnostics;
  const std::optional<EventsSpec> spec = events_spec_of(arguments.middleware);
  const ScenarioWithWorld loaded = load(arguments.of_scenario, diagnostics);
  const Scenario scenario = as_planned(loaded.scenario, diagnostics);
  const std::uint64_t seed = arguments.of_scenario.seed.value_or(scenario.seed);
  std::string plan = plan_of(arguments, diagnostics);
  if (spec) warn_of_missing_readers(arguments.middleware.spec, *spec, scenario, diagnostics);
  check_topics(arguments.middleware, scenario, diagnostics);
  print_warnings(diagnostics);
  require_token(arguments);

  Outlets outlets;
  attach(feed, outlets);
  if (llrp) attach(llrp, outlets);
  const MiddlewareRun middleware = attach_middleware(
      arguments.middleware, spec, start_time("serve", arguments.start, Time{}), outlets);
  const std::shared_ptr<LiveEstimates> estimates = live_estimates(arguments, scenario);
  if (estimates) attach(estimates, outlets);
  LiveWorld world(scenario, seed, outlets, live_options(arguments));
  world.attach(feed);
  if (middleware.events) world.attach(std::make_shared<EventClock>(middleware.events));
  const Closing closing(llrp.get());
  if (llrp) {
    world.attach(llrp);
    llrp->open(world);
  }
  http::Api api(loaded.scene, scenario, seed);
  if (estimates) {
    api.add(estimates);
    feed->add(estimates);
  }
  api.add_plan(std::move(plan));
  if (arguments.http) {
    feed->add(std::make_unique<http::LaserView>(loaded.scene, scenario, seed));
  }
  http::LiveAnswerer answerer(world, api);
  std::optional<http::HttpServer> server;
  if (arguments.http) {
    server.emplace(answerer, feed,
                   http::HttpOptions{arguments.listen, *arguments.http, arguments.token});
  }
  catch_interrupts();  // Before the server announces its address.
  print_addresses(llrp ? llrp->addresses() : std::vector<llrp::LlrpAddress>{},
                  server ? server->url() : std::string(), arguments.as_json);
  world.run(interrupted());
  const bool is_whole = finish(middleware, world.now());
  server.reset();
  if (llrp) llrp->close();
  end_estimates(estimates.get());
  return is_whole ? kExitOk : kExitBadInput;
}

}  // namespace

void add_serve_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand(
      "serve",
      "Run a scenario live: a page to watch it in, an API to change it, readers over LLRP");
  add_scenario_options(*command, arguments->of_scenario);
  command
      ->add_option(
          "--http", arguments->http,
          "Port of the page and the API; 0 for any free one (default 8080, with --llrp none)")
      ->check(CLI::Range(std::uint16_t{0}, std::uint16_t{65535}));
  command
      ->add_option("--llrp", arguments->llrp,
                   "LLRP port of the first reader, further readers have the next ones; 0 for any "
                   "free one. Readers then read when a client starts them")
      ->check(CLI::Range(std::uint16_t{0}, std::uint16_t{65535}));
  add_middleware_options(*command, arguments->middleware);
  add_start_option(*command, arguments->start);
  command->add_flag("--locate", arguments->locates,
                    "Locate tags while reads come in; the page shows where, and how sure that is, "
                    "as /api/estimates does");
  command
      ->add_option("--method", arguments->method, "By which method (default: as the scenario says)")
      ->needs("--locate");
  command
      ->add_option("--window", arguments->window_s,
                   "How long a read is used for that [s] (default 120)")
      ->check(CLI::Range(0.1, 1e6))
      ->needs("--locate");
  command->add_option("--plan", arguments->plan,
                      "Folder of a plan: the page shows its tag positions and antennas, with a "
                      "slider (default: that of the scenario, if it is a plan's layout.yaml)");
  command->add_option("--listen", arguments->listen,
                      "IP address to be reached at; 0.0.0.0 for all (default 127.0.0.1, by this "
                      "machine alone)");
  command->add_option("--token", arguments->token,
                      "Token required for commands from other machines (default: random)");
  add_speed_option(*command, arguments->speed, "1");
  add_json_option(*command, arguments->as_json,
                  "a line {\"http\": URL, \"llrp\": [{\"reader\", "
                  "\"address\", \"port\"}]}");
  command->add_flag("--paused", arguments->is_paused, "Start paused, until resumed");
  command->footer(
      "Then open the page that it names, or ask the API (docs/live.md):\n"
      "  curl -N http://127.0.0.1:8080/api/reads\n"
      "  curl -X POST http://127.0.0.1:8080/api/antennas/NAME/disconnect\n"
      "It runs until Ctrl-C: robots that have arrived stand still.");
  command->callback([arguments, &chosen] {
    chosen = [arguments] {
      ServeArguments asked = *arguments;
      if (!asked.http && !asked.llrp) asked.http = 8080;
      return serve(std::move(asked));
    };
  });
}

}  // namespace tagfield
