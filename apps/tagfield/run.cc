// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "adapters/http/run_json.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/long_runs.h"
#include "apps/tagfield/outlet_arguments.h"
#include "apps/tagfield/output_file.h"
#include "apps/tagfield/own_folder.h"
#include "apps/tagfield/program_version.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/shared_folder.h"
#include "apps/tagfield/table.h"
#include "apps/tagfield/top_view_file.h"
#include "apps/tagfield/track_files.h"
#include "tagfield/experiment/effect_breakdown.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/leave_one_out.h"
#include "tagfield/experiment/odometry_drift.h"
#include "tagfield/experiment/stoppable.h"
#include "tagfield/experiment/store/run_store.h"
#include "tagfield/experiment/store/work_hash.h"
#include "tagfield/experiment/tracing_forecast.h"
#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/csv_outlet.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/tag_positions_csv.h"
#include "tagfield/map/map_file.h"
#include "tagfield/report/estimates_csv.h"
#include "tagfield/report/page.h"
#include "tagfield/report/tracks_page.h"
#include "tagfield/scenario/late_tags.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

struct RunArguments {
  std::string scenario;
  std::string out;
  std::optional<std::uint64_t> seed;
  std::size_t seeds = 1;
  std::vector<std::string> settings;
  std::vector<std::string> without;
  bool force = false;
  bool leave_one_out = false;
  int threads = default_threads();
  bool no_page = false;
  bool breakdown = false;
  bool record_only = false;
  bool resume = false;
  bool as_json = false;
  OutletArguments outlets;
  WorldOptions world;
};

std::vector<AntennaPose> named(const std::vector<StampedPose>& path) {
  std::vector<AntennaPose> poses;
  poses.reserve(path.size());
  for (const StampedPose& pose : path) poses.push_back({pose.stamp, "robot", pose.X_WB});
  return poses;
}

/// Stages the map, and the believed and true path of the robot that made it.
void stage_navigation(const NavigationRun& navigation, StagedFolder& folder) {
  folder.add("map.pgm", map_to_pgm(navigation.map));
  folder.add("map.yaml", map_to_yaml(navigation.map, "map.pgm"));
  if (!navigation.survey) return;
  folder.add("mapping_path.csv", poses_to_csv(named(navigation.survey->believed_path)));
  folder.add("truth/mapping_path.csv", poses_to_csv(named(navigation.survey->true_path)));
}

/// Stages the results; reads and poses were written during the run.
void stage_run(const ScenarioWithWorld& loaded, const SeedRun& run, StagedFolder& folder) {
  folder.add("estimates.csv", estimates_to_csv(run.estimates));
  if (!run.corrected_poses.empty()) {
    folder.add("corrected_poses.csv", poses_to_csv(run.corrected_poses));
  }
  const KnownBeforehand known = known_beforehand(loaded.scenario);
  const std::map<std::string, double>& heights = known.heights.of_tag;
  if (!heights.empty()) folder.add("tag_heights.csv", tag_heights_to_csv(heights));
  if (!known.reference_tags.empty()) {
    folder.add("reference_tags.csv", tag_positions_to_csv(known.reference_tags));
  }
  const OdometryByAntenna odometry = odometry_of(loaded.scenario);
  if (!odometry.empty()) folder.add("odometry.csv", odometry_to_csv(odometry));
  if (run.navigation) stage_navigation(*run.navigation, folder);
  stage_top_view(loaded, folder);
  folder.add("scene.json", http::scene_json(loaded));
}

/// With many seeds, keeps finished ones until all are done, so that an interrupted run can be
/// continued; the first is always run again, as the folder shows its reads.
std::unique_ptr<RunStore> store_of(const RunArguments& arguments,
                                   const std::vector<Override>& overrides, const Scene& scene,
                                   const std::string& out) {
  if (arguments.seeds == 1) return nullptr;
  const LogHead head{program_version(),
                     work_hash(arguments.scenario, overrides, scene, arguments.without)};
  Diagnostics of_store;
  auto store = std::make_unique<RunStore>(out + "/" + kResumeLog, head,
                                          arguments.resume ? Resume::kYes : Resume::kNo, of_store);
  print_warnings(of_store);
  return store;
}

/// Runs all seeds; the first seed's tables are written to `folder` during its run.
std::vector<SeedRun> run_with_progress(const RunArguments& arguments,
                                       const ScenarioWithWorld& loaded,
                                       const NavigationWorld* world, RunStore* store,
                                       StagedFolder& folder, Diagnostics& diagnostics) {
  const Scenario& scenario = loaded.scenario;
  RunControl control;
  const RunOutlets outlets = attach_outlets(arguments.outlets, loaded, control);
  if (outlets.driving) control.remote = &*outlets.driving;
  StageBars bars;
  const std::string first =
      arguments.seeds > 1 ? fmt::format("{} seeds", arguments.seeds) : "simulating";
  control.keeps_recording = !arguments.record_only;
  attach(std::make_shared<CsvOutlet>(folder), control.outlets);
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.on_progress = [&](double share) { bars.show(first, share); };
  control.on_stage = [&bars](const std::string& what, double share) {
    bars.show("locating " + what, share);
  };
  const std::uint64_t seed = arguments.seed.value_or(scenario.seed);
  std::vector<SeedRun> runs =
      arguments.record_only
          ? std::vector<SeedRun>{simulate(scenario, seed, control, world)}
          : run_seeds(scenario, seed, arguments.seeds, control, diagnostics, world, store);
  for (const auto& sink : outlets.sinks) sink->finish();
  return runs;
}

/// The end of the run may be known only now, as when its robots arrive.
void warn_of_tags_after_end(const Scenario& scenario, const std::vector<SeedRun>& runs,
                            Diagnostics& diagnostics) {
  double end_s = 0.0;
  for (const SeedRun& run : runs) {
    if (!run.complete) return;
    end_s = std::max(end_s, run.simulated_s);
  }
  warn_of_late_tags(scenario, end_s, diagnostics);
  warn_of_late_kidnappings(scenario, end_s, diagnostics);
}

/// The breakdown; empty if not requested.
std::vector<EffectCost> breakdown_with_progress(const RunArguments& arguments,
                                                const Scenario& scenario,
                                                const NavigationWorld* world,
                                                Diagnostics& diagnostics) {
  if (!arguments.breakdown || interrupted()) return {};
  ProgressBar bar("effects");
  RunControl control;
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.on_progress = [&bar](double share) { bar.show(share); };
  // The run has already reported its warnings.
  Diagnostics unheard;
  std::vector<EffectCost> costs = break_down(scenario, arguments.seed.value_or(scenario.seed),
                                             arguments.seeds, control, unheard, world);
  if (costs.empty()) diagnostics.warn("--breakdown: no antenna has a physical model");
  return costs;
}

/// Adds the inventory without each antenna, if requested.
void add_leave_one_out(const RunArguments& arguments, const Scenario& scenario,
                       Diagnostics& diagnostics, Summary& summary) {
  if (!arguments.leave_one_out || interrupted()) return;
  if (!summary.inventory) {
    diagnostics.warn(
        "--leave-one-out is for inventories: it requires antennas that are all at rest, or "
        "localization.method=none");
    return;
  }
  ProgressBar bar("leave one out");
  RunControl control;
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.on_progress = [&bar](double share) { bar.show(share); };
  summary.inventory->without =
      leave_one_out(scenario, arguments.seed.value_or(scenario.seed), arguments.seeds, control);
}

/// If the scenario states where its tags move, tags that moved past the antennas are also tracked,
/// as they have no single position. For the first seed. Returns a one-line summary; "" if nothing
/// is tracked.
std::string stage_moving_tags(const Scenario& scenario, const SeedRun& run,
                              const RunArguments& arguments, Summary& summary, StagedFolder& folder,
                              Diagnostics& diagnostics) {
  const TrackingSpec& spec = scenario.tracking;
  const bool moved = std::any_of(run.outcomes.begin(), run.outcomes.end(),
                                 [](const TagOutcome& outcome) { return outcome.moved; });
  if (!moved || !summary.inventory || interrupted() || !(spec.options.lane || spec.line)) return "";
  TrackingRun tracked;
  tracked.seed = run.seed;
  tracked.reads = run.recording.reads;
  tracked.believed_poses = run.recording.believed_poses;
  tracked.truth = run.recording.truth;
  RunControl control;
  control.threads = arguments.threads;
  control.stop = &interrupted();
  try {
    track(spec, known_beforehand(scenario), control, tracked, diagnostics);
  } catch (const LocatingStopped&) {
    summary.complete = false;
    return "";
  }
  TrackSummary judged;
  judged.name = scenario.name;
  judged.method = to_string(spec.options.method);
  judged.seeds = {run.seed};
  judged.tags = tracked.outcomes;
  judged.orders = tracked.order_outcomes;
  stage_tracks(judged, tracked, !arguments.no_page, folder);
  return tracks_sentence(numbers_of(judged), tracked.orders) + "\n";
}

void print_result(const Summary& summary, const std::string& tracks, const std::string& out,
                  const RunArguments& arguments) {
  if (arguments.as_json) {
    fmt::print("{}", to_json(summary));
    return;
  }
  fmt::print("{}: {:.1f} m driven, {} reads in {:.1f} s simulated ({:.0f} times real time)\n",
             summary.scenario, summary.path_length_m, summary.reads, summary.simulated_s,
             summary.real_time_factor);
  fmt::print("{}{}", table_of(summary), tracks);
  if (!summary.complete) {
    fmt::print("INCOMPLETE: the run was interrupted{}\n",
               summary.seeds.size() > 1 ? "; --resume continues it" : "");
  }
  fmt::print("{}: {}\n", arguments.no_page ? "folder" : "page",
             arguments.no_page ? out : out + "/report.html");
}

/// Files of another run in the same folder that don't belong to this one.
std::vector<std::filesystem::path> stale_files() {
  std::vector<std::filesystem::path> all = track_file_names();
  for (const char* name :
       {"tag_heights.csv", "reference_tags.csv", "odometry.csv", "corrected_poses.csv",
        "top_view.json", "map.pgm", "map.yaml", "mapping_path.csv", "truth/mapping_path.csv",
        "report.html", "figures", "scene.json", "INCOMPLETE"}) {
    all.emplace_back(name);
  }
  return all;
}

/// Finishes a run that has only reads, poses and the truth.
int finish_recording(const SeedRun& run, const Diagnostics& diagnostics, const std::string& out,
                     StagedFolder& folder) {
  print_warnings(diagnostics);
  if (!run.complete) {
    folder.add(
        "INCOMPLETE",
        fmt::format("Interrupted at {:.3f} s simulated; the files are complete up to then.\n",
                    run.simulated_s));
  }
  std::vector<std::filesystem::path> stale = stale_files();
  stale.insert(stale.end(), {"estimates.csv", "summary.json"});
  folder.commit(stale);
  fmt::print("{:.1f} s simulated{}\nfolder: {}\n", run.simulated_s,
             run.complete ? "" : ", INCOMPLETE: the run was interrupted", out);
  return run.complete ? kExitOk : kExitInterrupted;
}

int run(const RunArguments& arguments) {
  if (arguments.out == "-") {
    throw Error(
        "run: --out must be a folder; 'tagfield stream' writes reads to the standard output");
  }
  const std::vector<Override> overrides = overrides_in(arguments.settings);
  suggest_shared_file(arguments.scenario);
  Diagnostics diagnostics;
  ScenarioWithWorld loaded =
      load_scenario_with_world(arguments.scenario, overrides, diagnostics, arguments.world);
  take_antennas_away(arguments.without, loaded.scenario);
  apply(arguments.outlets, loaded.scenario, diagnostics);
  const Scenario& scenario = loaded.scenario;
  // Other warnings are printed with the result.
  Diagnostics beforehand;
  warn_of_long_run(scenario, !arguments.record_only, beforehand);
  warn_of_long_tracing(scenario, beforehand);
  print_warnings(beforehand);
  const std::string out =
      arguments.out.empty() ? "runs/" + folder_name(scenario.name) : arguments.out;
  require_own_folder(out, scenario.name, arguments.force);
  require_replaceable(mcap_output(arguments.outlets.mcap), {arguments.scenario}, arguments.force);
  catch_interrupts();  // From here on an interruption would leave files in the folder.
  StagedFolder folder(out);
  std::optional<NavigationWorld> world;
  if (scenario.pose.source == PoseSource::kSlam) {
    world = navigation_world(scenario, loaded.scene, diagnostics);
  }
  const NavigationWorld* const ways = world ? &*world : nullptr;

  using Clock = std::chrono::steady_clock;
  const Clock::time_point begin = Clock::now();
  const std::unique_ptr<RunStore> store = store_of(arguments, overrides, loaded.scene, out);
  if (store) folder.keep(kResumeLog);
  const std::vector<SeedRun> runs =
      run_with_progress(arguments, loaded, ways, store.get(), folder, diagnostics);
  const double wall_s = std::chrono::duration<double>(Clock::now() - begin).count();
  warn_of_tags_after_end(scenario, runs, diagnostics);
  if (arguments.record_only) return finish_recording(runs.front(), diagnostics, out, folder);

  const std::vector<EffectCost> effects =
      breakdown_with_progress(arguments, scenario, ways, diagnostics);
  Summary summary = summarize(scenario, runs, wall_s, diagnostics, ways);
  summary.effects = effects;
  add_leave_one_out(arguments, scenario, diagnostics, summary);
  const std::string tracks =
      stage_moving_tags(scenario, runs.front(), arguments, summary, folder, diagnostics);
  summary.warnings = alike_as_one(diagnostics.warnings());
  summary.complete = summary.complete && runs.size() == arguments.seeds;
  print_warnings(diagnostics);
  stage_run(loaded, runs.front(), folder);
  folder.add("summary.json", to_json(summary));
  if (!summary.complete) folder.add("INCOMPLETE", "The run was interrupted; see summary.json.\n");
  if (!arguments.no_page) {
    const std::string staging = folder.staging().string();
    stage_report(staging, http::view_of(staging), folder);
  }
  folder.commit(stale_files());
  if (store && summary.complete) store->drop();
  print_result(summary, tracks, out, arguments);
  return summary.complete ? kExitOk : kExitInterrupted;
}

}  // namespace

void add_run_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<RunArguments>();
  CLI::App* command = app.add_subcommand(
      "run", "Simulate a scenario, locate its tags, compare with the truth, draw the page");
  command->add_option("SCENARIO", arguments->scenario, "Scenario file (YAML)")->required();
  add_world_options(*command, arguments->world);
  command->add_option("--seed", arguments->seed, "Seed instead of the scenario's")
      ->check(fault_of_seed);
  command->add_option("--seeds", arguments->seeds, "Run this many seeds, from --seed on")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  command->add_option("--out", arguments->out, "Folder for the results (default runs/NAME)");
  add_change_options(*command, arguments->settings, arguments->without);
  command->add_flag("--force", arguments->force,
                    "Replace results of another scenario in the folder, and with --mcap a file of "
                    "another kind");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-page", arguments->no_page, "Write the data only, no report.html");
  add_json_option(*command, arguments->as_json, "summary.json");
  command
      ->add_flag("--record-only", arguments->record_only,
                 "Write reads, poses and the truth as they come, and locate nothing: memory does "
                 "not grow with the run")
      ->excludes("--seeds")
      ->excludes("--json");
  command
      ->add_flag("--breakdown", arguments->breakdown,
                 "Run again with each effect of the physical models alone and with all but it, and "
                 "report what each costs")
      ->excludes("--record-only");
  command
      ->add_flag("--leave-one-out", arguments->leave_one_out,
                 "Run again without each antenna in turn, and report how many tags are read then")
      ->excludes("--record-only");
  command
      ->add_flag("--resume", arguments->resume,
                 "Resume a run of many seeds that was cut off, in the same folder")
      ->needs("--seeds");
  add_outlet_options(*command, arguments->outlets);
  command->footer(
      "The folder then holds reads.csv, antenna_poses.csv, estimates.csv, summary.json, truth/,\n"
      "report.html and figures/. Ctrl-C ends the run early and keeps the results so far, marked "
      "so.");
  command->callback([arguments, &chosen] { chosen = [arguments] { return run(*arguments); }; });
}

}  // namespace tagfield
