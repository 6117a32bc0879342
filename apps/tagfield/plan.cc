// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/own_folder.h"
#include "apps/tagfield/plan_arguments.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "apps/tagfield/top_view_file.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/report/plan_page.h"

namespace tagfield {
namespace {

void write(const AntennaPlan& plan, const std::string& layout,
           const std::vector<Silhouette>& outlines, StagedFolder& folder) {
  const std::vector<Figure> figures = plan_figures(plan, outlines);
  for (const Figure& figure : figures) {
    folder.add("figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  folder.add("plan.html", plan_page(plan, figures));
  folder.add("plan.json", plan_to_json(plan));
  folder.add("plan_layouts.csv", plan_layouts_to_csv(plan));
  folder.add("plan_antennas.csv", plan_antennas_to_csv(plan));
  folder.add("plan_positions.csv", plan_positions_to_csv(plan));
  folder.add("layout.yaml", layout);
  folder.commit({"figures"});
}

struct PlanArguments {
  std::string scenario;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  PlanQuestion question;
  bool no_links = false;
  bool force = false;
  bool as_json = false;
  WorldOptions world{};
  std::string out;
};

AntennaPlan with_progress(const ScenarioToPlan& to_plan, PlanQuestion question,
                          Diagnostics& diagnostics) {
  StageBars bars;
  question.stop = &interrupted();
  question.on_progress = [&bars](const std::string& stage, double share) {
    bars.show(stage, share);
  };
  return plan_antennas(to_plan, question, diagnostics);
}

int plan(const PlanArguments& arguments) {
  Diagnostics diagnostics;
  const std::vector<Override> overrides = overrides_in(arguments.settings);
  suggest_shared_file(arguments.scenario);
  const ScenarioToPlan to_plan =
      load_scenario_to_plan(arguments.scenario, overrides, diagnostics, arguments.world);
  PlanQuestion question = arguments.question;
  require_exact(question, to_plan.plan);
  const Scenario& scenario = to_plan.loaded.scenario;
  question.seed = arguments.seed.value_or(scenario.seed);
  const std::string out =
      arguments.out.empty() ? "runs/" + folder_name(scenario.name) + "_plan" : arguments.out;
  if (!arguments.no_links) question.links = (std::filesystem::path(out) / "links").string();
  require_own_folder(out, scenario.name, arguments.force);
  catch_interrupts();
  StagedFolder folder(out);
  AntennaPlan made;
  try {
    made = with_progress(to_plan, question, diagnostics);
  } catch (const Error& error) {
    if (!interrupted()) throw;
    fmt::print(stderr, "tagfield: {}\n", error.what());
    return kExitInterrupted;
  }
  print_warnings(diagnostics);
  const std::string layout = layout_to_yaml(arguments.scenario, overrides, to_plan,
                                            made.layouts[made.chosen], question.seed, out);
  write(made, layout, outlines_of(to_plan.loaded), folder);
  if (arguments.as_json) {
    fmt::print("{}", plan_to_json(made));
  } else {
    fmt::print("{0}layout: {1}/layout.yaml\npage: {1}/plan.html\n", plan_to_text(made), out);
  }
  return interrupted() ? kExitInterrupted : kExitOk;
}

}  // namespace

void add_plan_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<PlanArguments>();
  arguments->question.threads = default_threads();
  CLI::App* command = app.add_subcommand(
      "plan", "Decide where antennas go: layouts from one antenna up, what each reads and costs");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML) with a section 'plan'")
      ->required();
  command
      ->add_option("--set", arguments->settings,
                   "Replace a value of the scenario: plan.limits.antennas=8, model=multipath. Can "
                   "be given several times")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--seed", arguments->seed, "Seed instead of the scenario's")
      ->check(fault_of_seed);
  command
      ->add_option(
          "--samples", arguments->question.samples,
          "Samples of tags, hops and slots that each layout's range comes from (default 32)")
      ->check(CLI::Range(std::size_t{8}, std::size_t{10'000}));
  command
      ->add_option(
          "--check", arguments->question.check_seeds,
          "Run the chosen layout in full with this many other samples and seeds, and compare")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}));
  command
      ->add_option(
          "--exact", arguments->question.exact_s,
          "Look for the best layout of the chosen number of antennas by an integer program for up "
          "to this many seconds (needs CBC), and report how far the layout can be from it")
      ->check(CLI::Range(0.1, 86'400.0));
  command->add_flag("--no-links", arguments->no_links,
                    "Keep no links on disk: an interrupted plan can't be resumed");
  command->add_flag("--force", arguments->force,
                    "Replace results of another scenario in the folder");
  command->add_option("--out", arguments->out, "Folder for the results (default runs/NAME_plan)");
  add_world_options(*command, arguments->world);
  add_json_option(*command, arguments->as_json, "plan.json");
  command
      ->add_option("--threads", arguments->question.threads,
                   "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "The section 'plan' says where tags can be, where antennas can be, what is allowed and what\n"
      "is aimed at; scenarios/plan/store.yaml is one to start from, docs/plan.md has all keys.\n"
      "The folder then holds plan.html with a slider over the number of antennas, layout.yaml "
      "(the\n"
      "chosen layout as a scenario: tagfield run takes it as it is), plan.json, three tables, and\n"
      "links/, from which the same command resumes, or plans again with other limits at once.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return plan(*arguments); }; });
}

}  // namespace tagfield
