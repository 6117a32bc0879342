#include <fmt/format.h>

#include <cstdio>
#include <memory>
#include <optional>

#include "adapters/http/admission.h"
#include "adapters/http/http_server.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

struct ServeArguments {
  ScenarioArguments of_scenario;
  std::optional<std::uint16_t> http;
  std::string listen = "127.0.0.1";
  std::string token;
  std::string speed = "1";
  bool is_paused = false;
};

double speed_of(const std::string& word) {
  if (word == "max") return 0.0;
  double speed = 0.0;
  if (!CLI::detail::lexical_cast(word, speed) || !(speed > 0.0 && speed <= 1e6)) {
    throw Error(
        fmt::format("--speed {}: expected a multiple of real time up to 1e6, or max", word));
  }
  return speed;
}

bool is_loopback(const std::string& address) {
  return address == "::1" || address.rfind("127.", 0) == 0;
}

/// Who else can reach it must know a word.
void require_token(ServeArguments& arguments) {
  if (is_loopback(arguments.listen)) return;
  if (arguments.token.empty()) arguments.token = http::new_token();
  fmt::print(stderr,
             "tagfield: warning: others can reach {} and look at this world; commands need the "
             "token {}\n",
             arguments.listen, arguments.token);
}

int serve(ServeArguments arguments) {
  const double speed = speed_of(arguments.speed);
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded = load(arguments.of_scenario, diagnostics);
  const Scenario scenario = as_planned(loaded.scenario, diagnostics);
  const std::uint64_t seed = arguments.of_scenario.seed.value_or(scenario.seed);
  print_warnings(diagnostics);
  require_token(arguments);

  const auto feed = std::make_shared<http::LiveFeed>();
  Outlets outlets;
  attach(feed, outlets);
  LiveOptions options;
  options.speed = speed;
  options.is_paused = arguments.is_paused;
  LiveWorld world(scenario, seed, outlets, options);
  world.attach(feed);
  http::Api api(loaded.scene, scenario, seed);
  std::optional<http::HttpServer> server;
  if (arguments.http) {
    server.emplace(world, api, feed,
                   http::HttpOptions{arguments.listen, *arguments.http, arguments.token});
    fmt::print("http: {}\n", server->url());
  }
  std::fflush(stdout);
  catch_interrupts();
  world.run(interrupted());
  return kExitOk;
}

}  // namespace

void add_serve_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ServeArguments>();
  CLI::App* command = app.add_subcommand(
      "serve", "Let a scenario live: a page to watch it in, an API to change it by");
  add_scenario_options(*command, arguments->of_scenario);
  command
      ->add_option("--http", arguments->http,
                   "Port of the page and the API; 0 for any (default 8080)")
      ->check(CLI::Range(std::uint16_t{0}, std::uint16_t{65535}));
  command->add_option("--listen", arguments->listen,
                      "IP address to be reached at; 0.0.0.0 for all (default 127.0.0.1, by this "
                      "machine alone)");
  command->add_option("--token", arguments->token,
                      "That commands must bring, where others can reach it (default: drawn anew)");
  command->add_option("--speed", arguments->speed, "Multiple of real time, or max (default 1)");
  command->add_flag("--paused", arguments->is_paused, "Time stands until it is resumed");
  command->footer(
      "Then open the page that it names, or ask the API (docs/live.md):\n"
      "  curl -N http://127.0.0.1:8080/api/reads\n"
      "  curl -X POST http://127.0.0.1:8080/api/antennas/NAME/disconnect\n"
      "It goes on until Ctrl-C: robots that have arrived stand still.");
  command->callback([arguments, &chosen] {
    chosen = [arguments] {
      ServeArguments asked = *arguments;
      if (!asked.http) asked.http = 8080;
      return serve(std::move(asked));
    };
  });
}

}  // namespace tagfield
