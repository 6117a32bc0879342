// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/track.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <string_view>
#include <utility>

#include "apps/tagfield/commands.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/json_option.h"
#include "apps/tagfield/number_checks.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/stored_reads.h"
#include "apps/tagfield/track_files.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

bool is_scenario(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".yaml" || extension == ".yml";
}

void refuse_options_of_reads(const TrackArguments& arguments) {
  if (!arguments.poses.empty() || !arguments.scenario.empty() || !arguments.format.empty()) {
    throw Error(
        "track: --poses, --scenario and --format can only be used with reads, not with a scenario "
        "in their place");
  }
  if (arguments.part_reads) throw Error(kUselessParts);
  refuse_ros_options("track", arguments.ros);
  if (arguments.tag_height_m || !arguments.heights_file.empty()) {
    throw Error(
        "track: a scenario gives heights by localization.tag_height_m "
        "(--set localization.tag_height_m=NUMBER)");
  }
}

TrackResult track_scenario(const TrackArguments& arguments, Diagnostics& diagnostics) {
  refuse_options_of_reads(arguments);
  ScenarioWithWorld loaded = load(arguments, arguments.input, diagnostics);
  apply(arguments, loaded.scenario.tracking);
  ProgressBar bar(arguments.seeds > 1 ? fmt::format("{} seeds", arguments.seeds) : "tracking");
  RunControl control;
  control.threads = arguments.threads;
  control.stop = &interrupted();
  control.on_progress = [&bar](double share) { bar.show(share); };
  catch_interrupts();
  std::vector<TrackingRun> runs =
      track_seeds(loaded.scenario, arguments.seed.value_or(loaded.scenario.seed), arguments.seeds,
                  control, diagnostics);
  TrackResult result;
  result.complete = runs.size() == arguments.seeds && !interrupted();
  result.summary.name = loaded.scenario.name;
  result.summary.method = to_string(loaded.scenario.tracking.options.method);
  gather(runs, result.summary);
  if (!runs.empty()) result.first = std::move(runs.front());
  return result;
}

std::string line_of(const char* what, const std::optional<ErrorStatistics>& statistics,
                    double scale, const char* unit) {
  if (!statistics) return "";
  return fmt::format("  {}: mean {:.1f} {}, 95 % {:.1f}, max {:.1f}\n", what,
                     scale * statistics->mean, unit, scale * statistics->p95,
                     scale * statistics->max);
}

std::string table_of(const TrackSummary& summary) {
  std::string text;
  if (summary.seeds.size() == 1) {
    for (const TrackOutcome& outcome : summary.tags) {
      text += fmt::format("{:<16} {:<12} {:>5} reads", outcome.tag, to_string(outcome.verdict),
                          outcome.reads);
      if (outcome.verdict == TrackVerdict::kTracked) {
        text += fmt::format("  expected error {:.1f} mm", 1e3 * outcome.expected_error_m);
      }
      text += fmt::format("{}{}\n", outcome.reason.empty() ? "" : "  ", outcome.reason);
    }
  }
  text += fmt::format("{} ({}): {} tracked, {} ambiguous, {} not tracked\n", summary.name,
                      summary.method, count(summary, TrackVerdict::kTracked),
                      count(summary, TrackVerdict::kAmbiguous),
                      count(summary, TrackVerdict::kNotTracked));
  text += line_of("along the track", track_statistics(summary, &TrackOutcome::along_m), 1e3, "mm");
  text += line_of("across it", track_statistics(summary, &TrackOutcome::across_m), 1e3, "mm");
  text += line_of("speed", track_statistics(summary, &TrackOutcome::speed_m_s), 1e3, "mm/s");
  for (const OrderOutcome& order : summary.orders) {
    if (order.pairs == 0) continue;
    text += fmt::format(
        "  order at {}: {} of {} neighbours right ({:.2f} %)\n", order.name, order.right,
        order.pairs, 100.0 * static_cast<double>(order.right) / static_cast<double>(order.pairs));
  }
  return text;
}

std::string folder_of(const TrackArguments& arguments, const TrackResult& result) {
  if (!arguments.out.empty()) return arguments.out;
  if (!is_scenario(arguments.input)) return "runs/tracked";
  return "runs/" + folder_name(result.summary.name);
}

int tell(const TrackArguments& arguments, const TrackResult& result, const std::string& out) {
  if (arguments.as_json) {
    fmt::print("{}", to_json(result.summary));
  } else {
    fmt::print("{}{}: {}\n", table_of(result.summary), arguments.no_page ? "folder" : "page",
               arguments.no_page ? out : out + "/tracks.html");
    if (!result.complete) fmt::print("INCOMPLETE: the run was interrupted\n");
  }
  return result.complete ? kExitOk : kExitInterrupted;
}

/// Stages the files for a scenario's run, or for reads in memory.
void stage(const TrackArguments& arguments, const TrackResult& result, StagedFolder& folder) {
  if (is_scenario(arguments.input)) {
    folder.add("reads.csv", reads_to_csv(result.first.reads));
    folder.add("antenna_poses.csv", poses_to_csv(result.first.believed_poses));
    stage_truth(result.first.truth, folder);
  }
  stage_tracks(result.summary, result.first, !arguments.no_page, folder);
}

int track_command(const TrackArguments& arguments) {
  Diagnostics diagnostics;
  if (!arguments.old_speeds.empty()) diagnostics.warn("--speed MIN MAX is now --speed-range");
  TrackResult result = is_scenario(arguments.input)
                           ? track_scenario(arguments, diagnostics)
                           : track_reads(arguments, folder_of(arguments, {}), diagnostics);
  result.summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  if (!result.complete && result.summary.seeds.empty()) return kExitInterrupted;
  const std::string out = folder_of(arguments, result);
  catch_interrupts();
  const auto folder = result.parts ? result.parts : std::make_shared<StagedFolder>(out);
  if (result.parts) {
    stage_summary(result.summary, result.first, result.summary.tags.size(), result.reads_of_parts,
                  !arguments.no_page, *folder);
  } else {
    stage(arguments, result, *folder);
  }
  folder->commit(track_file_names());
  return tell(arguments, result, out);
}

void add_knowledge(CLI::App& command, TrackArguments& arguments) {
  command
      .add_option("--lane", arguments.lane,
                  "Lane along which tags move: X Y of a point [m], HEADING [deg from x towards y], "
                  "and how far to the side they may be (one sigma, default 0.1 m)")
      ->expected(3, 4)
      ->delimiter(',');
  command.add_flag("--bidirectional", arguments.bidirectional,
                   "Tags may also move backwards on the lane");
  command
      .add_option(
          "--line", arguments.line,
          "Line across which the tags' order is reported: X Y of a point [m], HEADING [deg]")
      ->expected(3)
      ->delimiter(',');
  command
      .add_option("--speed-range", arguments.speeds,
                  "Minimum and maximum speed of the tags [m/s] (default 0.05 3)")
      ->expected(2)
      ->delimiter(',');
  // In all other commands it is the speed of simulated time.
  command.add_option("--speed", arguments.old_speeds)->expected(2)->group("");
  command
      .add_option(
          "--acceleration-noise", arguments.acceleration_noise,
          "Process noise of the motion [m/s2/sqrt(Hz)]: after a time t the velocity has drifted by "
          "this times sqrt(t). Default 0.005, a conveyor; a person walks with 0.3. Where phases "
          "demand more, up to 30 times as much is tried (along a lane 100 times), with doubled "
          "errors")
      ->check(fault_of_non_negative);
  command
      .add_option("--tag-height", arguments.tag_height_m,
                  "Height of the tags [m, world] (default: estimated, near that of the antennas)")
      ->check(CLI::Range(-kMaxLength_m, kMaxLength_m));
  command.add_option("--tag-heights", arguments.heights_file,
                     "CSV: tag,height_m; takes precedence over --tag-height");
  command.add_option("--calibration", arguments.calibration,
                     "With reads, a profile by 'tagfield calibrate'");
}

}  // namespace

void apply(const TrackArguments& arguments, TrackingSpec& spec) {
  TrackingOptions& options = spec.options;
  if (arguments.method) options.method = track_method(*arguments.method);
  if (!arguments.lane.empty()) {
    Lane lane;
    lane.point = {arguments.lane[0], arguments.lane[1]};
    lane.heading_rad = radians(arguments.lane[2]);
    if (arguments.lane.size() > 3) lane.lateral_sigma_m = arguments.lane[3];
    options.lane = lane;
  }
  if (arguments.bidirectional) {
    if (!options.lane) throw Error("track: --bidirectional can only be used with a lane");
    options.lane->bidirectional = true;
  }
  if (!arguments.line.empty()) {
    spec.line = PassingLine{{arguments.line[0], arguments.line[1]}, radians(arguments.line[2])};
  }
  if (!arguments.speeds.empty() && !arguments.old_speeds.empty()) {
    throw Error("track: --speed is the former name of --speed-range: expected one of them");
  }
  const std::vector<double>& speeds =
      arguments.speeds.empty() ? arguments.old_speeds : arguments.speeds;
  if (!speeds.empty()) {
    options.min_speed_m_s = speeds[0];
    options.max_speed_m_s = speeds[1];
  }
  options.acceleration_noise = arguments.acceleration_noise.value_or(options.acceleration_noise);
  check(options);
}

/// Warns about keys of `localization` that were given on the command line and that tracking does
/// not use. A file's are for its other commands.
void warn_of_unused_keys(const std::vector<std::string>& settings, Diagnostics& diagnostics) {
  constexpr std::string_view kLocalization = "localization.";
  const std::vector<std::string_view> used = {"offset", "pi_ambiguity", "reference_tags",
                                              "tag_height_m", "tag_heights"};
  for (const std::string_view setting : settings) {
    if (setting.substr(0, kLocalization.size()) != kLocalization) continue;
    const std::string_view rest = setting.substr(kLocalization.size());
    const std::string_view key = rest.substr(0, rest.find_first_of(".=["));
    if (std::find(used.begin(), used.end(), key) != used.end()) continue;
    diagnostics.warn(
        fmt::format("--set: localization.{} has no effect on tracks; expected one of {}, or a key "
                    "of 'tracking'",
                    key, fmt::join(used, ", ")));
  }
}

ScenarioWithWorld load(const TrackArguments& arguments, const std::string& path,
                       Diagnostics& diagnostics) {
  warn_of_unused_keys(arguments.settings, diagnostics);
  return load(ScenarioArguments{path, arguments.settings, arguments.seed, {}, arguments.world},
              diagnostics);
}

void gather(const std::vector<TrackingRun>& runs, TrackSummary& summary) {
  for (const TrackingRun& run : runs) {
    summary.seeds.push_back(run.seed);
    summary.tags.insert(summary.tags.end(), run.outcomes.begin(), run.outcomes.end());
    add_orders(run.order_outcomes, summary.orders);
  }
}

void add_track_command(CLI::App& app, Action& chosen) {
  const auto arguments = std::make_shared<TrackArguments>();
  CLI::App* command = app.add_subcommand(
      "track", "Follow moving tags past antennas: tracks with covariances, and the tags' order");
  command
      ->add_option(
          "READS", arguments->input,
          "CSV: stamp_s,reader,antenna,tag,frequency_hz,phase_rad,rssi_dbm; the folder of "
          "a run; a recording of ROS (RUN.bag, RUN.mcap, RUN.db3, or rosbag2's folder); or a "
          "scenario (YAML), which is simulated, tracked and compared with the truth")
      ->required();
  command->add_option("--poses", arguments->poses,
                      "With reads as CSV, the antennas' poses (CSV: stamp_s,antenna,x_m,y_m,z_m,"
                      "qx,qy,qz,qw; one row for one at rest). With a recording of ROS: true, tf, "
                      "odometry, or auto (default): the true ones, else tf");
  add_format_option(*command, arguments->format);
  add_ros_options(*command, arguments->ros);
  add_part_option(*command, arguments->part_reads);
  command->add_option("--scenario", arguments->scenario,
                      "With reads, a scenario whose 'tracking' and heights are used");
  add_world_options(*command, arguments->world);
  command->add_option("--set", arguments->settings, "Replace a value of the scenario")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--method", arguments->method, "How tracks are smoothed (default ekf)")
      ->check(CLI::IsMember({"ekf", "ukf", "particle"}));
  add_knowledge(*command, *arguments);
  command->add_option("--seed", arguments->seed, "Seed instead of the scenario's")
      ->check(fault_of_seed);
  command->add_option("--seeds", arguments->seeds, "With a scenario, this many seeds")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  command->add_option("--out", arguments->out,
                      "Folder for the results (default runs/tracked, of a scenario runs/NAME)");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-page", arguments->no_page, "Write the data only, no tracks.html");
  add_json_option(*command, arguments->as_json, "tracks.json");
  command->footer(
      "Writes tracks.csv (a row for each stamp), verdicts.csv, order.csv (which tag passed the "
      "line,\n"
      "and each antenna at rest, when, and how surely before the next), tracks.json, tracks.svg, "
      "and\n"
      "tracks.html, a page with the tracks, when they passed what, their order and their speeds.\n"
      "From antennas in one vertical plane a tag and its mirror image look alike: then state\n"
      "the lane by --lane. For example, a belt along x with its middle at y = 0:\n"
      "  tagfield track reads.csv --poses poses.csv --lane 0 0 0 0.1 --line 0 0 90 --tag-height "
      "0.8\n"
      "Truth beside READS (truth/tags.csv) judges the tracks and is not used to make them.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return track_command(*arguments); }; });
}

}  // namespace tagfield
