// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <utility>

#include "adapters/archive/unpacked_archive.h"
#include "adapters/bags/bag_recording.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/progress_bar.h"
#include "apps/tagfield/recording.h"
#include "apps/tagfield/track.h"
#include "apps/tagfield/track_files.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/tag_heights_csv.h"
#include "tagfield/scenario/calibration_profile.h"

namespace tagfield {
namespace {

/// How tags are to be tracked, and prior knowledge of them.
struct Task {
  TrackingSpec spec;
  KnownBeforehand known;
};

Task task_of(const TrackArguments& arguments, Diagnostics& diagnostics) {
  if (arguments.seeds > 1) throw Error("track: --seeds can only be used with a scenario");
  Task task;
  auto& [spec, known] = task;
  if (!arguments.scenario.empty()) {
    const ScenarioWithWorld loaded = load(arguments, arguments.scenario, diagnostics);
    spec = loaded.scenario.tracking;
    known = known_beforehand(loaded.scenario);
  } else if (!arguments.settings.empty()) {
    throw Error("track: --set can only be used with a scenario");
  }
  if (arguments.scenario.empty() &&
      (arguments.world.skip_missing || arguments.world.allow_outside)) {
    throw Error("track: --skip-missing and --allow-outside can only be used with a scenario");
  }
  apply(arguments, spec);
  if (arguments.tag_height_m || !arguments.heights_file.empty()) known.heights = {};
  if (arguments.tag_height_m) known.heights.of_all = arguments.tag_height_m;
  if (!arguments.heights_file.empty()) {
    known.heights.of_tag = read_tag_heights_csv(arguments.heights_file);
  }
  return task;
}

/// Reads, poses and truth of tables or, in memory, of a ROS recording.
TrackingRun run_of(const TrackArguments& arguments, std::optional<LoadedRecording> recording,
                   Diagnostics& diagnostics) {
  TrackingRun run;
  run.seed = arguments.seed.value_or(1);
  if (recording) {
    run.reads = std::move(recording->reads);
    run.believed_poses = std::move(recording->poses.poses);
    run.truth = std::move(recording->truth);
    return run;
  }
  ReadsAndPoses tables =
      read_tables({"track", arguments.input, arguments.poses, arguments.format}, diagnostics);
  run.reads = std::move(tables.reads);
  run.believed_poses = std::move(tables.poses);
  run.truth = truth_beside(arguments.input);
  return run;
}

TrackResult tracked_whole(const TrackArguments& arguments, Task task,
                          std::optional<LoadedRecording> recording, Diagnostics& diagnostics) {
  auto [spec, known] = std::move(task);
  std::vector<TrackingRun> runs(1);
  runs[0] = run_of(arguments, std::move(recording), diagnostics);
  if (!arguments.calibration.empty()) {
    apply_calibration(read_calibration(arguments.calibration), runs[0].reads,
                      runs[0].believed_poses, known);
  }
  if (runs[0].reads.empty()) {
    diagnostics.warn({arguments.input, 0}, "no reads: cannot track anything");
  }
  RunControl control;
  control.threads = arguments.threads;
  track(spec, known, control, runs[0], diagnostics);
  TrackResult result;
  result.summary.name = arguments.input;
  result.summary.method = to_string(spec.options.method);
  gather(runs, result.summary);
  result.first = std::move(runs.front());
  return result;
}

/// A recording from a table of reads that don't fit in memory.
LoadedRecording stored_table(const TrackArguments& arguments, const TableFiles& files,
                             std::size_t part_reads, const std::string& out,
                             Diagnostics& diagnostics) {
  LoadedRecording recording;
  recording.poses = {"given", read_poses_csv(files.poses)};
  recording.truth = truth_that_fits(arguments.input, diagnostics);
  recording.stored =
      store_reads(reads_of_table(files.reads, diagnostics), out, part_reads, {}, diagnostics);
  return recording;
}

/// Tracks tags whose tracks may not fit in memory either.
TrackResult tracked_in_parts(const TrackArguments& arguments, Task task, const std::string& out,
                             LoadedRecording recording, Diagnostics& diagnostics) {
  auto [spec, known] = std::move(task);
  TrackResult result;
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
  result.parts = std::make_shared<StagedFolder>(out);
  TrackTables tables(*result.parts);
  {
    ProgressBar bar(fmt::format("tracking in {} parts", stored.store->parts()));
    track_in_parts(
        spec, known, arguments.threads, parts_of(stored, calibration),
        [&](const std::vector<TagTrack>& tracks) { tables.add(tracks); },
        [&](double share) { bar.show(share); }, run, diagnostics);
  }
  result.reads_of_parts = stored.source.overview.count;
  result.summary.seeds = {run.seed};
  result.summary.tags = std::move(run.outcomes);
  add_orders(run.order_outcomes, result.summary.orders);
  return result;
}

/// Whether reads can be stored in parts.
bool can_be_stored(const TrackArguments& arguments) {
  return is_bag(arguments.input) || (arguments.format.empty() && !is_archive(arguments.input));
}

/// The table and the reads per part if it is to be tracked in parts.
std::optional<std::pair<TableFiles, std::size_t>> table_for_parts(const TrackArguments& arguments) {
  if (!can_be_stored(arguments)) return std::nullopt;
  TableFiles files = own_tables("track", arguments.input, arguments.poses);
  const auto part = part_of_table(files.reads, arguments.part_reads);
  if (!part) return std::nullopt;
  return std::pair(std::move(files), *part);
}

/// A ROS recording, or tables whose reads don't fit in memory.
std::optional<LoadedRecording> recording_of(const TrackArguments& arguments, const std::string& out,
                                            Diagnostics& diagnostics) {
  if (is_bag(arguments.input)) {
    if (!arguments.format.empty()) throw Error("track: --format can only be used with CSV");
    return bag_recording(
        {"track", arguments.input, arguments.poses, arguments.ros, arguments.part_reads}, out, {},
        true, diagnostics);
  }
  refuse_ros_options("track", arguments.ros);
  const auto table = table_for_parts(arguments);
  if (!table) return std::nullopt;
  return stored_table(arguments, table->first, table->second, out, diagnostics);
}

}  // namespace

TrackResult track_reads(const TrackArguments& arguments, const std::string& out,
                        Diagnostics& diagnostics) {
  if (arguments.part_reads && !can_be_stored(arguments)) throw Error(kUselessParts);
  Task task = task_of(arguments, diagnostics);
  std::optional<LoadedRecording> recording = recording_of(arguments, out, diagnostics);
  if (recording && recording->stored) {
    return tracked_in_parts(arguments, std::move(task), out, std::move(*recording), diagnostics);
  }
  return tracked_whole(arguments, std::move(task), std::move(recording), diagnostics);
}

}  // namespace tagfield
