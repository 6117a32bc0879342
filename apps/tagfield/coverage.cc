// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <memory>

#include "apps/tagfield/commands.h"
#include "apps/tagfield/coverage_arguments.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/own_folder.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/top_view_file.h"
#include "tagfield/files/folder_entries.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/planning/moment.h"
#include "tagfield/report/coverage_figure.h"
#include "tagfield/report/coverage_page.h"

namespace tagfield {
namespace {

constexpr std::size_t kMaxTagsListed = 12;

std::vector<DriveSample> drive_of(const CoverageArguments& arguments, const Scenario& scenario) {
  std::optional<Time> time;
  if (arguments.time_s) time = time_from_seconds(*arguments.time_s);
  try {
    return sample_drive(scenario, arguments.of_scenario.seed.value_or(scenario.seed), time);
  } catch (const Error& error) {
    throw Error(fmt::format("coverage: {}", error.what()));
  }
}

Coverage compute(const Scenario& scenario, const std::vector<DriveSample>& samples,
                 WordedRequest& worded) {
  ProgressBar bar("coverage");
  worded.request.stop = &interrupted();
  worded.request.on_progress = [&bar](double share) { bar.show(share); };
  Coverage coverage = cover(scenario, samples, worded.request);
  coverage.tag_kind = worded.tag_kind;
  coverage.orientation = worded.orientation;
  coverage.moment = worded.moment;
  return coverage;
}

/// Tables of earlier results at other heights.
std::vector<std::filesystem::path> stale_files(const std::string& folder) {
  std::vector<std::filesystem::path> stale = {"figures"};
  for (const std::filesystem::path& entry : entries_of(folder)) {
    const std::string name = entry.filename().string();
    if (name.rfind("coverage_", 0) == 0 && entry.extension() == ".csv") {
      stale.emplace_back(name);
    }
  }
  return stale;
}

void write(const Coverage& coverage, const std::vector<Silhouette>& outlines,
           const std::string& out, StagedFolder& folder) {
  for (const CoverageLayer& layer : coverage.layers) {
    folder.add(coverage_file(layer), coverage_to_csv(coverage, layer));
  }
  folder.add("coverage_tags.csv", coverage_tags_to_csv(coverage));
  folder.add("coverage.json", coverage_to_json(coverage));
  const std::vector<Figure> figures = coverage_figures(coverage, outlines);
  for (const Figure& figure : figures) {
    folder.add("figures/" + figure.name + ".svg",
               standalone_svg(figure.svg, figure.title, figure.caption));
  }
  folder.add("coverage.html", coverage_page(coverage, figures));
  folder.commit(stale_files(out));
}

void print_tags(const Coverage& coverage, TagVerdict verdict, const char* title) {
  std::string names;
  std::size_t count = 0;
  for (const TagCoverage& tag : coverage.tags) {
    if (tag.verdict != verdict) continue;
    if (++count > kMaxTagsListed) continue;
    const bool has_readers = verdict != TagVerdict::kNever;
    names += fmt::format("  {}{}\n", tag.id, has_readers ? ": " + spoken(coverage, tag) : "");
  }
  if (count == 0) return;
  fmt::print("{}: {} of {} tags\n{}", title, count, coverage.tags.size(), names);
  if (count > kMaxTagsListed)
    fmt::print("  … and {} more (coverage_tags.csv)\n", count - kMaxTagsListed);
}

void print(const Coverage& coverage, bool is_of_one_moment, const std::string& out) {
  fmt::print("{}: {} cells of {:g} m, {}\n", coverage.scenario, coverage.grid.size(),
             coverage.grid.step_m, coverage.tag_kind);
  for (const CoverageLayer& layer : coverage.layers) {
    fmt::print("at {:.2f} m: {:.1f} % of the area read\n", layer.height_m + 0.0,
               100.0 * share_read(layer));
  }
  fmt::print("in {:g} s{}: {:.0f} of {} tags read, {:.0f} to {:.0f} with 95 % confidence\n",
             coverage.run_s, is_of_one_moment ? " with all as it is " + coverage.moment : "",
             coverage.expected_read.mean, coverage.tags.size(),
             std::ceil(coverage.expected_read.low), std::floor(coverage.expected_read.high));
  print_tags(coverage, TagVerdict::kNever, "never read");
  print_tags(coverage, TagVerdict::kSeldom, "seldom read");
  print_tags(coverage, TagVerdict::kWrong, "read by the wrong reader");
  print_tags(coverage, TagVerdict::kAlsoOther, "read by others too");
  fmt::print("page: {}/coverage.html\n", out);
}

int coverage(const CoverageArguments& arguments) {
  Diagnostics diagnostics;
  ScenarioWithWorld loaded = load(arguments.of_scenario, diagnostics);
  loaded.scenario = as_planned(loaded.scenario, diagnostics);
  warn_of_effects_left_out(loaded.scenario, diagnostics);
  if (arguments.time_s) {
    leave_out_absent_tags(time_from_seconds(*arguments.time_s), loaded.scenario, diagnostics);
  }
  const std::vector<DriveSample> samples = drive_of(arguments, loaded.scenario);
  WordedRequest worded = request_of(arguments, loaded, samples, diagnostics);
  const std::string out = arguments.out.empty()
                              ? "runs/" + folder_name(loaded.scenario.name) + "_coverage"
                              : arguments.out;
  require_own_folder(out, loaded.scenario.name, arguments.force);
  catch_interrupts();  // From here on an interruption would leave files in the folder.
  StagedFolder folder(out);
  Coverage result;
  try {
    result = compute(loaded.scenario, samples, worded);
  } catch (const Error& error) {
    if (!interrupted()) throw;
    fmt::print(stderr, "tagfield: {}\n", error.what());
    return kExitInterrupted;
  }
  result.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  write(result, outlines_of(loaded), out, folder);
  if (arguments.as_json) {
    fmt::print("{}", coverage_to_json(result));
  } else {
    print(result, arguments.time_s.has_value(), out);
  }
  return kExitOk;
}

void add_options(CLI::App& command, CoverageArguments& arguments) {
  add_scenario_options(command, arguments.of_scenario);
  command
      .add_option(
          "--antenna", arguments.antennas,
          "Name of an antenna, or all that match: 'port_*' (default: all). Can be given several "
          "times")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--tag-profile", arguments.tag_profile,
                     "Kind of tag in the maps, a file of profiles/tags (default: the first tag's)");
  // A second one is refused by name.
  command
      .add_option("--tag", arguments.tags,
                  "The maps are of this tag of the scenario: its kind and settings")
      ->take_all()
      ->expected(1);
  command
      .add_option(
          "--tag-set", arguments.tag_settings,
          "A setting of the maps' tag: sensitivity_dbm=-20, pattern=isotropic. Can be given "
          "several times")
      ->take_all()
      ->allow_extra_args(false);
  command.add_option("--orientation", arguments.orientation,
                     "Its orientation: ROLL,PITCH,YAW [rad], or 'any' for the mean and 'worst' for "
                     "the worst of twelve (default 0,0,0)");
  command
      .add_option("--height", arguments.heights_m,
                  "Height of a map [m]; can be given several times (default: the tags')")
      ->take_all()
      ->allow_extra_args(false)
      ->check(CLI::Range(-1000.0, 1000.0));
  command
      .add_option("--step", arguments.step_m,
                  "Size of a cell [m] (default 0.1, or larger so that it takes about ten seconds)")
      ->check(CLI::Range(0.001, 1000.0));
  command.add_option("--region", arguments.region,
                     "X_LOW,Y_LOW,X_HIGH,Y_HIGH [m] (default: the whole world)");
  command
      .add_option("--time", arguments.time_s,
                  "Evaluate this moment of the run [s] instead of all of it")
      ->check(CLI::Range(0.0, 1e9));
  command.add_option("--out", arguments.out, "Folder for the results (default runs/NAME_coverage)");
  command.add_flag("--force", arguments.force, "Replace results of another scenario in the folder");
  add_json_option(command, arguments.as_json, "coverage.json");
  command.add_option("--threads", arguments.threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
}

}  // namespace

void add_coverage_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<CoverageArguments>();
  CLI::App* command = app.add_subcommand(
      "coverage", "Draw where in the hall a tag would be read, and list tags that never are");
  add_options(*command, *arguments);
  command->footer(
      "Moving antennas are evaluated every 0.25 m of their path, and the best position counts.\n"
      "The folder then holds coverage.html with a map of read probability, margin, power and best\n"
      "antenna for each height, the same as figures/*.svg and coverage_HEIGHTm.csv, "
      "coverage.json,\n"
      "and coverage_tags.csv: the scenario's own tags, never read, or by which antenna. For "
      "example\n"
      "  tagfield coverage scenarios/two_antennas.yaml --set model=multipath --height 1 --step "
      "0.2\n"
      "docs/coverage.md says what the figures mean, and what a read probability is.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return coverage(*arguments); }; });
}

}  // namespace tagfield
