// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/plan.h"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/own_folder.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/top_view_file.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/layout/layout_scenario.h"
#include "tagfield/layout/plan_check.h"
#include "tagfield/report/plan_page.h"

namespace tagfield {
namespace {

struct PlanArguments {
  std::string scenario;
  std::vector<std::string> settings;
  std::optional<std::uint64_t> seed;
  std::size_t samples = 32;
  std::size_t check_seeds = 0;
  double exact_s = 0.0;
  bool no_links = false;
  bool force = false;
  bool as_json = false;
  WorldOptions world{};
  std::string out;
  int threads = default_threads();
};

LinkMatrix links_of(const PlanArguments& arguments, const ScenarioToPlan& to_plan,
                    std::uint64_t seed, const std::string& out, Diagnostics& diagnostics) {
  ProgressBar bar("links");
  LinkMatrixRequest request;
  request.seed = seed;
  request.threads = arguments.threads;
  if (!arguments.no_links) request.folder = (std::filesystem::path(out) / "links").string();
  request.stop = &interrupted();
  request.on_progress = [&bar](double share) { bar.show(share); };
  LinkMatrixCounts counts;
  LinkMatrix matrix = evaluate_links(to_plan, request, counts);
  if (counts.damaged > 0) {
    diagnostics.warn(fmt::format("{}: {} files of links were not whole; they are computed again",
                                 request.folder, counts.damaged));
  }
  return matrix;
}

std::string limits_text(const PlanSpec& plan) {
  const PlanLimits& limits = plan.limits;
  std::string text = fmt::format("{} antennas, {} readers of {} ports", limits.antennas,
                                 limits.readers, limits.ports);
  if (limits.cost) text += fmt::format(", cost {:g}", *limits.cost);
  if (limits.cross) {
    text += fmt::format(", at most {:g} % of a zone read by others", 100.0 * *limits.cross);
  }
  if (plan.margin_db > 0.0)
    text += fmt::format("; {:g} dB to spare where tags are to be read", plan.margin_db);
  return text;
}

void add_check(const PlanArguments& arguments, const ScenarioToPlan& to_plan, std::uint64_t seed,
               AntennaPlan& plan) {
  if (arguments.check_seeds == 0) return;
  ProgressBar bar("check");
  RunControl control;
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.on_progress = [&bar](double share) { bar.show(share); };
  plan.check = check_plan(to_plan, plan.layouts[plan.chosen], seed, arguments.check_seeds, control);
}

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
  folder.add("plan_places.csv", plan_places_to_csv(plan));
  folder.add("layout.yaml", layout);
  folder.commit({"figures"});
}

void print_layouts(const AntennaPlan& plan) {
  fmt::print("{:>9} {:>8} {:>8} {:>10} {:>16} {:>8} {:>8}\n", "antennas", "readers", "cost",
             "tags read", "95 % of runs", "score", "bound");
  for (std::size_t i = 0; i < plan.layouts.size(); ++i) {
    const PlannedLayout& layout = plan.layouts[i];
    fmt::print(
        "{:>9} {:>8} {:>8g} {:>10.1f} {:>16} {:>8.4f} {:>8.4f}{}{}\n", layout.antennas.size(),
        layout.readers, layout.cost, layout.read.mean,
        fmt::format("{:.0f} to {:.0f}", std::ceil(layout.read.low), std::floor(layout.read.high)),
        layout.score, layout.bound, layout.is_exact ? " exact" : "",
        i == plan.chosen ? "  <- chosen" : "");
  }
}

void print_chosen(const AntennaPlan& plan) {
  const PlannedLayout& layout = plan.layouts[plan.chosen];
  for (const PlannedAntenna& antenna : layout.antennas) {
    fmt::print(
        "  {:<20} {:<14} at ({:.2f}, {:.2f}, {:.2f}) m, looks along ({:.2f}, {:.2f}, {:.2f}), "
        "{:g} dBm\n",
        antenna.name, antenna.reader, antenna.p_W.x() + 0.0, antenna.p_W.y() + 0.0,
        antenna.p_W.z() + 0.0, antenna.boresight_W.x() + 0.0, antenna.boresight_W.y() + 0.0,
        antenna.boresight_W.z() + 0.0, antenna.power_dbm);
  }
  for (const PlannedZone& zone : layout.zones) {
    fmt::print("  zone {}: {:.1f} of {} tags read, {:.1f} by others (up to {:.0f})\n", zone.zone,
               zone.read.mean, zone.tags, zone.cross.mean, std::floor(zone.cross.high));
  }
  const double gap = std::max(0.0, layout.bound - layout.score);
  fmt::print("no layout of {} antennas within the limits scores {}{}\n", layout.antennas.size(),
             gap < 5e-5 ? "more" : fmt::format("over {:.4f} more", gap),
             plan.guaranteed ? fmt::format("; the greedy algorithm guarantees {:.0f} % of the best",
                                           std::floor(100.0 * *plan.guaranteed))
                             : std::string());
}

void print_plan(const AntennaPlan& plan, const std::string& out) {
  fmt::print("{}: {} tags in {} places, {} ways to mount an antenna\n", plan.scenario, plan.tags,
             plan.places.size(), plan.options);
  print_layouts(plan);
  print_chosen(plan);
  for (const PlanVariant& variant : plan.sensitivity) {
    fmt::print("  {}: {:.1f} tags read\n", variant.what, variant.read.mean);
  }
  if (plan.check) {
    fmt::print("checked: {} of {} full simulations within the stated range\n", plan.check->inside,
               plan.check->read.size());
    if (!plan.check->cross.empty()) {
      fmt::print("cross reads: {} of {} within the stated range\n", plan.check->cross_inside,
                 plan.check->cross.size());
    }
  }
  fmt::print("layout: {0}/layout.yaml\npage: {0}/plan.html\n", out);
}

void warn_of_shortfall(const AntennaPlan& plan, Diagnostics& diagnostics) {
  if (plan.reaches_aim) return;
  diagnostics.warn(fmt::format(
      "plan.aim.share {:g} is not reached: the best layout found has {:.4f}{}", *plan.aim_share,
      plan.layouts[plan.chosen].score,
      plan.stopped_by.empty() ? std::string()
                              : fmt::format("; plan.{} keeps more out", plan.stopped_by)));
}

AntennaPlan plan_with_progress(const PlanArguments& arguments, const ScenarioToPlan& to_plan,
                               const LinkMatrix& matrix, std::uint64_t seed) {
  ProgressBar bar("layouts");
  PlanRequest request;
  request.seed = seed;
  request.samples = arguments.samples;
  request.threads = arguments.threads;
  request.exact_s = arguments.exact_s;
  request.stop = &interrupted();
  request.on_progress = [&bar](double share) { bar.show(share); };
  return make_plan(to_plan, matrix, request);
}

int plan(const PlanArguments& arguments) {
  Diagnostics diagnostics;
  const std::vector<Override> overrides = overrides_in(arguments.settings);
  if (arguments.exact_s > 0.0 && !has_exact_solver()) best_exactly({}, {}, arguments.exact_s);
  const ScenarioToPlan to_plan =
      load_scenario_to_plan(arguments.scenario, overrides, diagnostics, arguments.world);
  const Scenario& scenario = to_plan.loaded.scenario;
  const std::uint64_t seed = arguments.seed.value_or(scenario.seed);
  const std::string out =
      arguments.out.empty() ? "runs/" + folder_name(scenario.name) + "_plan" : arguments.out;
  require_own_folder(out, scenario.name, arguments.force);
  catch_interrupts();
  StagedFolder folder(out);
  AntennaPlan made;
  try {
    const LinkMatrix matrix = links_of(arguments, to_plan, seed, out, diagnostics);
    made = plan_with_progress(arguments, to_plan, matrix, seed);
    made.limits = limits_text(to_plan.plan);
    add_check(arguments, to_plan, seed, made);
  } catch (const Error& error) {
    if (!interrupted()) throw;
    fmt::print(stderr, "tagfield: {}\n", error.what());
    return kExitInterrupted;
  }
  warn_of_shortfall(made, diagnostics);
  made.warnings = alike_as_one(diagnostics.warnings());
  print_warnings(diagnostics);
  const std::string layout =
      layout_to_yaml(arguments.scenario, overrides, to_plan, made.layouts[made.chosen], seed, out);
  write(made, layout, outlines_of(to_plan.loaded), folder);
  if (arguments.as_json) {
    fmt::print("{}", plan_to_json(made));
  } else {
    print_plan(made, out);
  }
  return interrupted() ? kExitInterrupted : kExitOk;
}

}  // namespace

void add_plan_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<PlanArguments>();
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
          "--samples", arguments->samples,
          "Samples of tags, hops and slots that each layout's range comes from (default 32)")
      ->check(CLI::Range(std::size_t{8}, std::size_t{10'000}));
  command
      ->add_option(
          "--check", arguments->check_seeds,
          "Run the chosen layout in full with so many other samples and seeds, and compare")
      ->check(CLI::Range(std::size_t{1}, std::size_t{10'000}));
  command
      ->add_option(
          "--exact", arguments->exact_s,
          "Look for the best layout of the chosen number of antennas by an integer program "
          "for up to so many seconds (needs CBC), and say how far the layout can be from it")
      ->check(CLI::Range(0.1, 86'400.0));
  command->add_flag("--no-links", arguments->no_links,
                    "Keep no links on disk: nothing to go on from where it is interrupted");
  command->add_flag("--force", arguments->force,
                    "Replace results of another scenario in the folder");
  command->add_option("--out", arguments->out, "Folder for the results (default runs/NAME_plan)");
  add_world_options(*command, arguments->world);
  add_json_option(*command, arguments->as_json, "plan.json");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->footer(
      "The section 'plan' says where tags can be, where antennas can be, what is allowed and what\n"
      "is aimed at; scenarios/plan/store.yaml is one to start from, docs/plan.md has all keys.\n"
      "The folder then holds plan.html with a slider over the number of antennas, layout.yaml "
      "(the\n"
      "chosen layout as a scenario: tagfield run takes it as it is), plan.json, three tables, and\n"
      "links/, from which the same command goes on or plans again with other limits at once.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return plan(*arguments); }; });
}

}  // namespace tagfield
