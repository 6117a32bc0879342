// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include "adapters/archive/unpacked_archive.h"
#include "adapters/bags/bag_recording.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/progress_bar.h"
#include "tagfield/base/file_kind.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/files/truth_csv.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

/// The folder of a table, or of a run.
fs::path folder_of_reads(const std::string& reads) {
  return is_folder(reads) ? fs::path(reads) : fs::path(reads).parent_path();
}

std::map<std::string, Trajectory> by_name(const std::vector<AntennaPose>& poses) {
  std::map<std::string, Trajectory> trajectories;
  for (const AntennaPose& pose : poses) {
    trajectories[pose.antenna].push_back({pose.stamp, pose.X_WA});
  }
  return trajectories;
}

/// Longest path of any one antenna [m].
double longest_path(const std::vector<AntennaPose>& poses) {
  double longest = 0.0;
  for (const auto& [antenna, trajectory] : by_name(poses)) {
    longest = std::max(longest, path_length(trajectory));
  }
  return longest;
}

/// Path length driven by all robots, if known, else that of the antenna that moved most [m].
double driven_path(const Truth& truth, const std::vector<AntennaPose>& poses) {
  if (truth.robot_poses.empty()) return longest_path(poses);
  double sum = 0.0;
  for (const auto& [robot, trajectory] : by_name(truth.robot_poses)) {
    sum += path_length(trajectory);
  }
  return sum;
}

BagOptions options_of(const BagArguments& arguments) {
  BagOptions options;
  options.frequency_hz = arguments.ros.frequency_hz;
  if (arguments.poses == "odometry") options.frames = {"world", "odom"};
  if (!arguments.ros.frame.empty()) options.frames = {arguments.ros.frame};
  return options;
}

std::string frames_of_reads(const BagRecording& bag) {
  std::set<std::string> antennas;
  for (const TagRead& read : bag.reads) antennas.insert(read.antenna);
  if (bag.unreported) {
    for (const auto& [antenna, last] : bag.unreported->overview.last_by_antenna) {
      antennas.insert(antenna);
    }
  }
  return fmt::format("'{}'", fmt::join(antennas, "', '"));
}

std::string no_transforms(const BagOptions& options) {
  return fmt::format("no transforms (tf) from '{}' to the frames of the reads",
                     fmt::join(options.frames, "', '"));
}

/// A frame that nothing is found in would otherwise go unnoticed where there is a truth.
void refuse_useless_frame(const BagArguments& arguments, const BagOptions& options,
                          const BagRecording& bag) {
  const std::string& frame = arguments.ros.frame;
  if (frame.empty() || bag.unreported || bag.reads.empty()) return;
  if (bag.believed.source == "given") {
    fail({arguments.bag, 0},
         fmt::format("its poses come with its reads, in '{}': --frame is for poses by tf",
                     bag.believed.frame));
  }
  if (bag.believed.poses.empty() && !bag.truth.antenna_poses.empty()) {
    fail({arguments.bag, 0},
         fmt::format("--frame {}: there are {}", frame, no_transforms(options)));
  }
}

/// Stores the requested poses in `poses` and `other`.
void choose_poses(const BagArguments& arguments, const BagOptions& options, BagRecording& bag,
                  LoadedRecording& recording) {
  refuse_useless_frame(arguments, options, bag);
  const NamedPoses truth = {"true", bag.truth.antenna_poses};
  NamedPoses believed = {bag.believed.source, std::move(bag.believed.poses)};
  const std::string& wanted = arguments.poses;
  const bool automatic = wanted.empty() || wanted == "auto";
  if (wanted == "true" || (automatic && !truth.poses.empty())) {
    recording.poses = truth;
    recording.other = std::move(believed);
  } else {
    recording.poses = std::move(believed);
    recording.other = truth;
  }
  if (!recording.poses.poses.empty() || (bag.reads.empty() && !bag.unreported)) return;
  if (wanted == "true") {
    fail({arguments.bag, 0}, "has no true antenna poses (tagfield_msgs/AntennaTruth)");
  }
  fail({arguments.bag, 0},
       fmt::format("has no poses of the antennas {}: {}{}", frames_of_reads(bag),
                   automatic ? "no tagfield_msgs/AntennaTruth and " : "", no_transforms(options)));
}

BagRecording bag_with_progress(const std::string& path, BagOptions options,
                               Diagnostics& diagnostics) {
  ProgressBar bar("reading");
  options.on_progress = [&bar](double share) { bar.show(share); };
  return read_bag(path, options, diagnostics);
}

/// Errors are only meaningful in the same frame.
void compare_frames(const std::string& file, const BagRecording& bag, bool beliefs_used,
                    Diagnostics& diagnostics) {
  const std::string& frame = bag.believed.frame;
  if (!beliefs_used || bag.truth_frame.empty() || frame.empty() || frame == bag.truth_frame) return;
  diagnostics.warn({file, 0}, fmt::format("poses by tf are in '{}', the truth in '{}', and no "
                                          "transform joins them: they are taken to be the same",
                                          frame, bag.truth_frame));
}

/// Reads that don't fit in memory are stored in parts, or else read again.
void keep_elsewhere(ReadSource source, std::optional<std::size_t> part, const std::string& out,
                    const std::set<std::string>& references, LoadedRecording& recording,
                    Diagnostics& diagnostics) {
  recording.overview = source.overview;
  if (part) {
    recording.stored = store_reads(std::move(source), out, *part, references, diagnostics);
  } else {
    recording.source = std::move(source);
  }
}

/// Maximum number of a bag's reads to keep in memory.
std::size_t max_reads(const BagArguments& arguments, bool keep) {
  if (arguments.part_reads) {
    return *arguments.part_reads == 0 ? std::numeric_limits<std::size_t>::max() : 0;
  }
  return keep ? kManyReads : kReadsToReadAnew;
}

/// Number of reads per part if they are to be processed in parts: also those that should be kept in
/// memory but don't fit.
std::optional<std::size_t> part_of_bag(const BagArguments& arguments,
                                       const UnreportedReads& unreported, bool keep) {
  if (arguments.part_reads) return arguments.part_reads;
  const bool in_parts = keep || unreported.overview.count > kManyReads;
  return in_parts ? std::optional(kReadsOfPart) : std::nullopt;
}

/// Takes the reads of a bag that has too many for memory.
void take_unreported(const BagArguments& arguments, const std::string& out,
                     const std::set<std::string>& references, bool keep, LoadedRecording& recording,
                     Diagnostics& diagnostics) {
  keep_elsewhere(reads_of_bag(arguments.bag, *recording.unreported),
                 part_of_bag(arguments, *recording.unreported, keep), out, references, recording,
                 diagnostics);
  if (!recording.stored) return;
  recording.other = {};
  diagnostics.warn({arguments.bag, 0},
                   fmt::format("its reads are processed in parts: with the poses '{}' alone, "
                               "without a comparison with others",
                               recording.poses.name));
}

bool is_of_lost_part(const std::string& warning) {
  const auto says = [&warning](const char* what) {
    return warning.find(what) != std::string::npos;
  };
  return says("cut off") || says("received at time 0") || says("its compression is unknown");
}

/// What a recording lacks is mostly in the part that can't be read, of which only a warning would
/// tell.
void fail_by_damage(const std::string& bag, const Error& error, const Diagnostics& diagnostics) {
  for (const std::string& warning : diagnostics.warnings()) {
    if (warning.rfind(bag + ": ", 0) != 0 || !is_of_lost_part(warning)) continue;
    throw Error(fmt::format("{} ({})", error.what(), warning.substr(bag.size() + 2)));
  }
}

LoadedRecording whole_recording(const BagArguments& arguments, const std::string& out,
                                const std::set<std::string>& references, bool keep,
                                Diagnostics& diagnostics) {
  const std::set<std::string> words = {"", "auto", "true", "tf", "odometry"};
  if (words.count(arguments.poses) == 0) {
    throw Error(fmt::format("{}: --poses is '{}', expected {} for a bag", arguments.command,
                            arguments.poses, kPoseWords));
  }
  BagOptions options = options_of(arguments);
  options.max_reads = max_reads(arguments, keep);
  if (arguments.poses != "tf" && arguments.poses != "odometry") {
    options.max_reads_believed = arguments.part_reads ? 0 : kManyReads;
  }
  BagRecording bag = bag_with_progress(arguments.bag, options, diagnostics);
  LoadedRecording recording;
  choose_poses(arguments, options, bag, recording);
  compare_frames(arguments.bag, bag,
                 recording.poses.name != "true" || !recording.other.poses.empty(), diagnostics);
  if (bag.unreported) {
    recording.unreported = std::move(bag.unreported);
    take_unreported(arguments, out, references, keep, recording, diagnostics);
  } else {
    recording.reads = std::move(bag.reads);
    recording.overview = overview_of(recording.reads);
  }
  recording.truth = std::move(bag.truth);
  recording.path_length_m = driven_path(recording.truth, recording.poses.poses);
  recording.duration_s = bag.duration_s;
  return recording;
}

}  // namespace

Truth truth_beside(const std::string& reads) {
  const fs::path folder = folder_of_reads(reads);
  if (!is_there(folder / "truth" / "tags.csv")) return {};
  return read_truth(folder.empty() ? "." : folder.string());
}

Truth truth_that_fits(const std::string& reads, Diagnostics& diagnostics) {
  const fs::path tags = folder_of_reads(reads) / "truth" / "tags.csv";
  if (is_there(tags) && fs::file_size(tags) > kLargeTable) {
    diagnostics.warn({tags.string(), 0}, "does not fit in memory: nothing is judged by it");
    return {};
  }
  return truth_beside(reads);
}

EachRead reads_of(const LoadedRecording& recording) {
  if (!recording.source) return each_of(recording.reads);
  return EachRead([&recording](const EachRead::Take& take) {
    recording.source->for_each(take, [](double /*share*/) {});
  });
}

LoadedRecording csv_recording(const LocalizeArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics) {
  LoadedRecording recording;
  const bool can_be_stored = arguments.format.empty() && !is_archive(arguments.recording);
  if (arguments.part_reads && !can_be_stored) {
    throw Error(
        "localize: --part-reads can only be used with CSV in Tagfield's own form, not packed, and "
        "with recordings of ROS");
  }
  std::optional<std::size_t> part;
  TableFiles files;
  if (can_be_stored) {
    files = own_tables("localize", arguments.recording, arguments.poses);
    part = part_of_table(files.reads, arguments.part_reads);
  }
  if (part || (can_be_stored && !keep && is_read_anew(files.reads))) {
    recording.poses = {"given", read_poses_csv(files.poses)};
    recording.table = files.reads;
    keep_elsewhere(reads_of_table(files.reads, diagnostics), part, out, references, recording,
                   diagnostics);
  } else {
    ReadsAndPoses tables = read_tables(
        {"localize", arguments.recording, arguments.poses, arguments.format}, diagnostics);
    recording.reads = std::move(tables.reads);
    recording.poses = {"given", std::move(tables.poses)};
    recording.overview = overview_of(recording.reads);
  }
  if (is_run(arguments.recording)) {
    recording.truth = truth_that_fits(arguments.recording, diagnostics);
    const fs::path distances = fs::path(arguments.recording) / kDistancesFile;
    if (is_there(distances)) recording.true_distances = distances.string();
  }
  recording.path_length_m = driven_path(recording.truth, recording.poses.poses);
  const ReadOverview& reads = recording.overview;
  if (reads.count > 0) recording.duration_s = to_seconds(reads.last - reads.first);
  return recording;
}

LoadedRecording bag_recording(const BagArguments& arguments, const std::string& out,
                              const std::set<std::string>& references, bool keep,
                              Diagnostics& diagnostics) {
  try {
    return whole_recording(arguments, out, references, keep, diagnostics);
  } catch (const Error& error) {
    fail_by_damage(arguments.bag, error, diagnostics);
    throw;
  }
}

}  // namespace tagfield
