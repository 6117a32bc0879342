// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <utility>

#include "adapters/archive/unpacked_archive.h"
#include "adapters/ros1/bag_recording.h"
#include "apps/tagfield/command_line.h"
#include "apps/tagfield/commands.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/recording.h"
#include "apps/tagfield/scenario_arguments.h"
#include "apps/tagfield/track_files.h"
#include "tagfield/base/range_check.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/experiment/tracking_run.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/staged_folder.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/files/truth_csv.h"
#include "tagfield/scenario/calibration_profile.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

struct TrackArguments {
  std::string input;     ///< Reads as CSV, or a scenario.
  std::string poses;     ///< CSV; "" with a scenario.
  std::string format;    ///< How other people's tables are to be read, or "".
  std::string scenario;  ///< Besides reads, or "".
  std::vector<std::string> settings;
  std::optional<std::string> method;
  std::vector<double> lane;   ///< X Y HEADING_DEG [SIGMA_M].
  std::vector<double> line;   ///< X Y HEADING_DEG.
  std::vector<double> speed;  ///< MIN MAX.
  bool both_ways = false;
  std::optional<double> acceleration_noise;
  std::optional<double> tag_height_m;
  std::string heights_file;
  std::string calibration;
  std::optional<std::uint64_t> seed;
  std::size_t seeds = 1;
  std::string out;
  std::optional<std::size_t> part_reads;  ///< See part_of_table().
  int threads = default_threads();
  bool no_page = false;
  bool as_json = false;
  WorldOptions world{};
};

bool is_scenario(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  return extension == ".yaml" || extension == ".yml";
}

/// What the command line says goes before what the scenario says.
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
  if (arguments.both_ways) {
    if (!options.lane) throw Error("track: --both-ways goes with a lane only");
    options.lane->both_ways = true;
  }
  if (!arguments.line.empty()) {
    spec.line = PassingLine{{arguments.line[0], arguments.line[1]}, radians(arguments.line[2])};
  }
  if (!arguments.speed.empty()) {
    options.min_speed_m_s = arguments.speed[0];
    options.max_speed_m_s = arguments.speed[1];
  }
  options.acceleration_noise = arguments.acceleration_noise.value_or(options.acceleration_noise);
  check(options);
}

ScenarioWithWorld load(const TrackArguments& arguments, const std::string& path,
                       Diagnostics& diagnostics) {
  return load(ScenarioArguments{path, arguments.settings, arguments.seed, {}, arguments.world},
              diagnostics);
}

void refuse_options_of_reads(const TrackArguments& arguments) {
  if (!arguments.poses.empty() || !arguments.scenario.empty() || !arguments.format.empty()) {
    throw Error(
        "track: --poses, --scenario and --format go with reads, not with a scenario in their "
        "place");
  }
  if (arguments.tag_height_m || !arguments.heights_file.empty()) {
    throw Error(
        "track: a scenario gives heights by localization.tag_height_m "
        "(--set localization.tag_height_m=NUMBER)");
  }
}

struct Result {
  TrackSummary summary;
  TrackingRun first;
  bool complete = true;
};

void gather(const std::vector<TrackingRun>& runs, TrackSummary& summary) {
  for (const TrackingRun& run : runs) {
    summary.seeds.push_back(run.seed);
    summary.tags.insert(summary.tags.end(), run.outcomes.begin(), run.outcomes.end());
    add_orders(run.order_outcomes, summary.orders);
  }
}

Result track_scenario(const TrackArguments& arguments, Diagnostics& diagnostics) {
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
  Result result;
  result.complete = runs.size() == arguments.seeds && !interrupted();
  result.summary.name = loaded.scenario.name;
  result.summary.method = to_string(loaded.scenario.tracking.options.method);
  gather(runs, result.summary);
  if (!runs.empty()) result.first = std::move(runs.front());
  return result;
}

/// Beside reads of a run there is its truth, which judges the tracks and makes none.
Truth truth_beside(const std::string& reads) {
  const fs::path folder = fs::is_directory(reads) ? fs::path(reads) : fs::path(reads).parent_path();
  if (!fs::exists(folder / "truth" / "tags.csv")) return {};
  return read_truth(folder.empty() ? "." : folder.string());
}

/// How tags that were read are to be tracked, and what is known of them.
struct Task {
  TrackingSpec spec;
  KnownBeforehand known;
};

Task task_of(const TrackArguments& arguments, Diagnostics& diagnostics) {
  if (arguments.seeds > 1) throw Error("track: --seeds goes with a scenario only");
  Task task;
  auto& [spec, known] = task;
  if (!arguments.scenario.empty()) {
    const ScenarioWithWorld loaded = load(arguments, arguments.scenario, diagnostics);
    spec = loaded.scenario.tracking;
    known = known_beforehand(loaded.scenario);
  } else if (!arguments.settings.empty()) {
    throw Error("track: --set goes with a scenario only");
  }
  if (arguments.scenario.empty() &&
      (arguments.world.skip_missing || arguments.world.allow_outside)) {
    throw Error("track: --skip-missing and --allow-outside go with a scenario only");
  }
  apply(arguments, spec);
  if (arguments.tag_height_m || !arguments.heights_file.empty()) known.heights = {};
  if (arguments.tag_height_m) known.heights.of_all = arguments.tag_height_m;
  if (!arguments.heights_file.empty()) {
    known.heights.of_tag = read_tag_heights_csv(arguments.heights_file);
  }
  return task;
}

/// Reads, poses and truth of tables or, in memory, of a recording of ROS.
TrackingRun run_of(const TrackArguments& arguments, std::optional<LoadedRecording> recording) {
  TrackingRun run;
  run.seed = arguments.seed.value_or(1);
  if (recording) {
    run.reads = std::move(recording->reads);
    run.believed_poses = std::move(recording->poses.poses);
    run.truth = std::move(recording->truth);
    return run;
  }
  ReadsAndPoses tables = read_tables("track", arguments.input, arguments.poses, arguments.format);
  run.reads = std::move(tables.reads);
  run.believed_poses = std::move(tables.poses);
  run.truth = truth_beside(arguments.input);
  return run;
}

Result track_reads(const TrackArguments& arguments, Task task,
                   std::optional<LoadedRecording> recording, Diagnostics& diagnostics) {
  auto [spec, known] = std::move(task);
  std::vector<TrackingRun> runs(1);
  runs[0] = run_of(arguments, std::move(recording));
  if (!arguments.calibration.empty()) {
    apply_calibration(read_calibration(arguments.calibration), runs[0].reads,
                      runs[0].believed_poses, known);
  }
  if (runs[0].reads.empty()) {
    diagnostics.warn({arguments.input, 0}, "no reads: cannot track anything");
  }
  track(spec, known, arguments.threads, runs[0], diagnostics);
  Result result;
  result.summary.name = arguments.input;
  result.summary.method = to_string(spec.options.method);
  gather(runs, result.summary);
  result.first = std::move(runs.front());
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

std::string folder_of(const TrackArguments& arguments, const Result& result) {
  if (!arguments.out.empty()) return arguments.out;
  if (!is_scenario(arguments.input)) return "runs/tracked";
  return "runs/" + folder_name(result.summary.name);
}

int tell(const TrackArguments& arguments, const Result& result, const std::string& out) {
  if (arguments.as_json) {
    fmt::print("{}", to_json(result.summary));
  } else {
    fmt::print("{}{}: {}\n", table_of(result.summary), arguments.no_page ? "folder" : "page",
               arguments.no_page ? out : out + "/tracks.html");
    if (!result.complete) fmt::print("INCOMPLETE: the run was interrupted\n");
  }
  return result.complete ? kExitOk : kExitInterrupted;
}

/// Judges nothing where the truth itself doesn't fit in memory.
Truth truth_that_fits(const std::string& reads, Diagnostics& diagnostics) {
  const fs::path folder = fs::is_directory(reads) ? fs::path(reads) : fs::path(reads).parent_path();
  const fs::path tags = folder / "truth" / "tags.csv";
  if (fs::exists(tags) && fs::file_size(tags) > kLargeTable) {
    diagnostics.warn({tags.string(), 0}, "does not fit in memory: the tracks are not judged by it");
    return {};
  }
  return truth_beside(reads);
}

/// A table of reads that don't fit in memory, with all else.
LoadedRecording stored_table(const TrackArguments& arguments, const TableFiles& files,
                             std::size_t part_reads, const std::string& out,
                             Diagnostics& diagnostics) {
  LoadedRecording recording;
  recording.poses = {"given", read_poses_csv(files.poses)};
  recording.truth = truth_that_fits(arguments.input, diagnostics);
  recording.stored = store_reads(reads_of_table(files.reads), out, part_reads, {}, diagnostics);
  return recording;
}

/// Tracks tags whose tracks may not fit in memory either.
int track_parts(const TrackArguments& arguments, Task task, const std::string& out,
                LoadedRecording recording, Diagnostics& diagnostics) {
  auto [spec, known] = std::move(task);
  Result result;
  result.summary.name = arguments.input;
  result.summary.method = to_string(spec.options.method);
  TrackingRun& run = result.first;
  run.seed = arguments.seed.value_or(1);
  run.believed_poses = std::move(recording.poses.poses);
  run.truth = std::move(recording.truth);
  const StoredReads& stored = *recording.stored;
  std::optional<Calibration> calibration;
  if (!arguments.calibration.empty()) {
    calibration = read_calibration(arguments.calibration);
    std::vector<TagRead> none;
    apply_calibration(*calibration, none, run.believed_poses, known);
  }
  StagedFolder folder(out);
  TrackTables tables(folder);
  {
    ProgressBar bar(fmt::format("tracking in {} parts", stored.store->parts()));
    track_in_parts(
        spec, known, arguments.threads, parts_of(stored, calibration),
        [&](const std::vector<TagTrack>& tracks) { tables.add(tracks); },
        [&](double share) { bar.show(share); }, run, diagnostics);
  }
  result.summary.seeds = {run.seed};
  result.summary.tags = std::move(run.outcomes);
  add_orders(run.order_outcomes, result.summary.orders);
  result.summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  catch_interrupts();
  stage_summary(result.summary, run, result.summary.tags.size(), stored.source.overview.count,
                !arguments.no_page, folder);
  folder.commit(track_file_names());
  return tell(arguments, result, out);
}

/// Whether reads can be stored in parts.
bool can_be_stored(const TrackArguments& arguments) {
  if (is_scenario(arguments.input)) return false;
  return is_bag(arguments.input) || (arguments.format.empty() && !is_archive(arguments.input));
}

/// The table where it is to be tracked in parts.
std::optional<std::pair<TableFiles, std::size_t>> table_for_parts(const TrackArguments& arguments) {
  if (!can_be_stored(arguments)) return std::nullopt;
  TableFiles files = own_tables("track", arguments.input, arguments.poses);
  const auto part = part_of_table(files.reads, arguments.part_reads);
  if (!part) return std::nullopt;
  return std::pair(std::move(files), *part);
}

/// A recording of ROS, or tables whose reads don't fit in memory.
std::optional<LoadedRecording> recording_of(const TrackArguments& arguments, const std::string& out,
                                            Diagnostics& diagnostics) {
  if (is_bag(arguments.input)) {
    if (!arguments.format.empty()) throw Error("track: --format goes with CSV only");
    return bag_recording(
        {"track", arguments.input, arguments.poses, "", std::nullopt, arguments.part_reads}, out,
        {}, true, diagnostics);
  }
  const auto table = table_for_parts(arguments);
  if (!table) return std::nullopt;
  return stored_table(arguments, table->first, table->second, out, diagnostics);
}

int track_command(const TrackArguments& arguments) {
  Diagnostics diagnostics;
  if (arguments.part_reads && !can_be_stored(arguments)) {
    throw Error(
        "track: --part-reads goes with CSV in Tagfield's own form, not packed, and with recordings "
        "of ROS only");
  }
  Result result;
  if (is_scenario(arguments.input)) {
    result = track_scenario(arguments, diagnostics);
  } else {
    Task task = task_of(arguments, diagnostics);
    const std::string out = folder_of(arguments, {});
    std::optional<LoadedRecording> recording = recording_of(arguments, out, diagnostics);
    if (recording && recording->stored) {
      return track_parts(arguments, std::move(task), out, std::move(*recording), diagnostics);
    }
    result = track_reads(arguments, std::move(task), std::move(recording), diagnostics);
  }
  result.summary.warnings = diagnostics.warnings();
  print_warnings(diagnostics);
  if (!result.complete && result.summary.seeds.empty()) return kExitInterrupted;
  const std::string out = folder_of(arguments, result);
  catch_interrupts();
  StagedFolder folder(out);
  if (is_scenario(arguments.input)) {
    folder.add("reads.csv", reads_to_csv(result.first.reads));
    folder.add("antenna_poses.csv", poses_to_csv(result.first.believed_poses));
    stage_truth(result.first.truth, folder);
  }
  stage_tracks(result.summary, result.first, !arguments.no_page, folder);
  folder.commit(track_file_names());
  return tell(arguments, result, out);
}

void add_knowledge(CLI::App& command, TrackArguments& arguments) {
  command
      .add_option("--lane", arguments.lane,
                  "Where tags run: X Y of a point [m], HEADING [deg from x towards y], and how far "
                  "to the side they may be (one sigma, default 0.1 m)")
      ->expected(3, 4);
  command.add_flag("--both-ways", arguments.both_ways, "On the lane tags may also run backwards");
  command
      .add_option(
          "--line", arguments.line,
          "Line across which the tags' order is reported: X Y of a point [m], HEADING [deg]")
      ->expected(3);
  command.add_option("--speed", arguments.speed, "Least and greatest speed [m/s] (default 0.05 3)")
      ->expected(2);
  command
      .add_option("--acceleration-noise", arguments.acceleration_noise,
                  "How unsteady the motion is [m/s2/sqrt(Hz)]: after a time t the velocity has "
                  "strayed by this times sqrt(t). Default 0.005, a conveyor; a person walks with "
                  "0.3")
      ->check(CLI::NonNegativeNumber);
  command
      .add_option("--tag-height", arguments.tag_height_m,
                  "Height of the tags [m, world]; without it, it is estimated about the antennas'")
      ->check(CLI::Range(-kMostLength_m, kMostLength_m));
  command.add_option("--tag-heights", arguments.heights_file,
                     "CSV: tag,height_m; takes precedence over --tag-height");
  command.add_option("--calibration", arguments.calibration,
                     "With reads, a profile by 'tagfield calibrate'");
}

}  // namespace

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
  add_part_option(*command, arguments->part_reads);
  command->add_option("--scenario", arguments->scenario,
                      "With reads, a scenario whose 'tracking' and heights are to be used");
  add_world_options(*command, arguments->world);
  command->add_option("--set", arguments->settings, "Replace a value of the scenario")
      ->take_all()
      ->allow_extra_args(false);
  command->add_option("--method", arguments->method, "How tracks are smoothed (default ekf)")
      ->check(CLI::IsMember({"ekf", "ukf", "particle"}));
  add_knowledge(*command, *arguments);
  command->add_option("--seed", arguments->seed, "Seed instead of the scenario's")
      ->check(fault_of_seed);
  command->add_option("--seeds", arguments->seeds, "With a scenario, so many seeds")
      ->check(CLI::Range(std::size_t{1}, std::size_t{1'000'000}));
  command->add_option("--out", arguments->out,
                      "Folder for the results (default runs/tracked, of a scenario runs/NAME)");
  command->add_option("--threads", arguments->threads, "Threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024));
  command->add_flag("--no-page", arguments->no_page, "Write the data only, no tracks.html");
  add_json_option(*command, arguments->as_json, "tracks.json");
  command->footer(
      "Writes tracks.csv (a row for each stamp), verdicts.csv, order.csv (who passed the line, "
      "and\n"
      "each antenna at rest, when, and how surely before the next), tracks.json, tracks.svg, and\n"
      "tracks.html, a page with the tracks, when they passed what, their order and their speeds.\n"
      "From antennas in one vertical plane a tag and its mirror image look alike: then say by\n"
      "--lane where tags run. For example, a belt along x with its middle at y = 0:\n"
      "  tagfield track reads.csv --poses poses.csv --lane 0 0 0 0.1 --line 0 0 90 --tag-height "
      "0.8\n"
      "Truth beside READS (truth/tags.csv) judges the tracks and is not used to make them.");
  command->callback(
      [arguments, &chosen] { chosen = [arguments] { return track_command(*arguments); }; });
}

}  // namespace tagfield
