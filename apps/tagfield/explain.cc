// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <memory>
#include <nlohmann/json.hpp>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/explain_text.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/scenario_arguments.h"
#include "tagfield/planning/explanation_json.h"
#include "tagfield/planning/link_at.h"
#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

struct ExplainArguments {
  ScenarioArguments of_scenario;
  std::string antenna;
  std::string tag;
  double time_s = 0.0;
  bool as_json = false;
};

LinkExplanation explain_moment(const Scenario& scenario, const ExplainArguments& arguments) {
  const AntennaSpec* const antenna =
      arguments.antenna.empty() ? nullptr : &antenna_named("explain", scenario, arguments.antenna);
  const TagSpec& tag = tag_named("explain", scenario, arguments.tag);
  const std::uint64_t seed = arguments.of_scenario.seed.value_or(scenario.seed);
  const Time time = time_from_seconds(arguments.time_s);
  try {
    return antenna == nullptr ? explain_best_link_at(scenario, tag, time, seed)
                              : explain_link_at(scenario, *antenna, tag, time, seed);
  } catch (const Error& error) {
    throw Error(fmt::format("explain: {}", error.what()));
  }
}

int explain(const ExplainArguments& arguments) {
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded = load(arguments.of_scenario, diagnostics);
  const Scenario scenario = as_planned(loaded.scenario, diagnostics);
  const LinkExplanation link = explain_moment(scenario, arguments);
  print_warnings(diagnostics);
  if (arguments.as_json) {
    nlohmann::ordered_json json = to_json(link);
    json["warnings"] = diagnostics.warnings();
    fmt::print("{}\n", json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  } else {
    fmt::print("{}", to_text(link));
  }
  return kExitOk;
}

}  // namespace

void add_explain_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<ExplainArguments>();
  CLI::App* command = app.add_subcommand(
      "explain",
      "Explain why an antenna reads a tag or not: the link budget line by line, the paths");
  add_scenario_options(*command, arguments->of_scenario);
  command->add_option("--antenna", arguments->antenna,
                      "Name of the antenna (default: the one with the best link)");
  command->add_option("--tag", arguments->tag, "ID of the tag (default: the only one)");
  command
      ->add_option("--time", arguments->time_s,
                   "Moment of the run [s]: robots, lifts and tags are where they are then "
                   "(default 0)")
      ->check(CLI::Range(0.0, 1e9));
  add_json_option(*command, arguments->as_json, "with all paths");
  command->footer(
      "The first line is the verdict:\n"
      "  read: +6.2 dB at the tag, +21.0 dB at the reader\n"
      "  not read: −3.1 dB at the tag, behind rack_4 (metal)\n"
      "Margins are the power beyond what chip and receiver need. docs/explain.md says what\n"
      "each line means. With the paper's model it compares distance with range; for all else:\n"
      "  tagfield explain scenarios/paper_warehouse.yaml --set model=multipath --tag tag3 --time "
      "20\n"
      "Robots that navigate by laser are taken to drive straight over their waypoints.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return explain(*arguments); }; });
}

}  // namespace tagfield
