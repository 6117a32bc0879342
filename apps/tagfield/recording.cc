// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>

#include "adapters/archive/unpacked_archive.h"
#include "adapters/ros1/bag_recording.h"
#include "apps/tagfield/foreign_tables.h"
#include "apps/tagfield/progress_bar.h"
#include "tagfield/files/poses_csv.h"
#include "tagfield/files/read_overview.h"
#include "tagfield/files/reads_csv.h"

namespace tagfield {
namespace {

std::map<std::string, Trajectory> by_name(const std::vector<AntennaPose>& poses) {
  std::map<std::string, Trajectory> trajectories;
  for (const AntennaPose& pose : poses) {
    trajectories[pose.antenna].push_back({pose.stamp, pose.X_WA});
  }
  return trajectories;
}

/// Longest way of any one antenna [m].
double longest_path(const std::vector<AntennaPose>& poses) {
  double longest = 0.0;
  for (const auto& [antenna, trajectory] : by_name(poses)) {
    longest = std::max(longest, path_length(trajectory));
  }
  return longest;
}

/// Way driven by all robots, where that is known, else of the antenna that moved most [m].
double driven_path(const Truth& truth, const std::vector<AntennaPose>& poses) {
  if (truth.robot_poses.empty()) return longest_path(poses);
  double sum = 0.0;
  for (const auto& [robot, trajectory] : by_name(truth.robot_poses)) {
    sum += path_length(trajectory);
  }
  return sum;
}

BagOptions options_of(const LocalizeArguments& arguments) {
  BagOptions options;
  options.frequency_hz = arguments.frequency_hz;
  if (arguments.poses == "odometry") options.frames = {"world", "odom"};
  if (!arguments.frame.empty()) options.frames = {arguments.frame};
  return options;
}

std::string frames_of_reads(const BagRecording& bag) {
  std::set<std::string> antennas;
  for (const TagRead& read : bag.reads) antennas.insert(read.antenna);
  return fmt::format("'{}'", fmt::join(antennas, "', '"));
}

/// Puts into `poses` and `other` what was asked for.
void choose_poses(const LocalizeArguments& arguments, const BagOptions& options, BagRecording& bag,
                  RecordingToLocalize& recording) {
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
  if (!recording.poses.poses.empty() || bag.reads.empty()) return;
  if (wanted == "true") {
    fail({arguments.recording, 0}, "has no true antenna poses (tagfield_msgs/AntennaTruth)");
  }
  fail({arguments.recording, 0},
       fmt::format("has no poses of the antennas {}: {}no transforms (tf) from '{}' to the frames "
                   "of the reads",
                   frames_of_reads(bag), automatic ? "no tagfield_msgs/AntennaTruth and " : "",
                   fmt::join(options.frames, "', '")));
}

/// Only in the same frame do errors mean anything.
void compare_frames(const std::string& file, const BagRecording& bag, bool beliefs_used,
                    Diagnostics& diagnostics) {
  const std::string& frame = bag.believed.frame;
  if (!beliefs_used || bag.truth_frame.empty() || frame.empty() || frame == bag.truth_frame) return;
  diagnostics.warn({file, 0}, fmt::format("poses by tf are in '{}', the truth in '{}', and no "
                                          "transform joins them: they are taken to be the same",
                                          frame, bag.truth_frame));
}

}  // namespace

EachRead reads_of(const RecordingToLocalize& recording) {
  if (recording.table.empty()) return each_of(recording.reads);
  return EachRead([&recording](const EachRead::Take& take) {
    std::size_t count = 0;
    for_each_read(recording.table, [&](const TagRead& read) {
      ++count;
      take(read);
    });
    require_same_count(recording.table, recording.overview.count, count);
  });
}

RecordingToLocalize csv_recording(const LocalizeArguments& arguments, const std::string& out,
                                  const std::set<std::string>& references, bool keep,
                                  Diagnostics& diagnostics) {
  RecordingToLocalize recording;
  const bool can_be_stored = arguments.format.empty() && !is_archive(arguments.recording);
  if (arguments.part_reads && !can_be_stored) {
    throw Error("localize: --part-reads goes with CSV in Tagfield's own form only, not packed");
  }
  std::optional<std::size_t> part;
  TableFiles files;
  if (can_be_stored) {
    files = own_tables("localize", arguments.recording, arguments.poses);
    part = part_of_table(files.reads, arguments.part_reads);
  }
  if (part) {
    recording.poses = {"given", read_poses_csv(files.poses)};
    recording.stored = store_reads(files.reads, out, *part, references, diagnostics);
    recording.overview = recording.stored->overview;
  } else if (can_be_stored && !keep && is_read_anew(files.reads)) {
    recording.poses = {"given", read_poses_csv(files.poses)};
    recording.table = files.reads;
    ProgressBar bar("reading");
    for_each_read(
        files.reads, [&](const TagRead& read) { add(read, recording.overview); },
        [&](double share) { bar.show(share); });
  } else {
    ReadsAndPoses tables =
        read_tables("localize", arguments.recording, arguments.poses, arguments.format);
    recording.reads = std::move(tables.reads);
    recording.poses = {"given", std::move(tables.poses)};
    recording.overview = overview_of(recording.reads);
  }
  recording.path_length_m = longest_path(recording.poses.poses);
  return recording;
}

RecordingToLocalize bag_recording(const LocalizeArguments& arguments, Diagnostics& diagnostics) {
  const std::set<std::string> words = {"", "auto", "true", "tf", "odometry"};
  if (words.count(arguments.poses) == 0) {
    throw Error(fmt::format("localize: --poses is '{}', expected {} for a bag", arguments.poses,
                            kPoseWords));
  }
  BagOptions options = options_of(arguments);
  ProgressBar bar("reading");
  options.on_progress = [&bar](double share) { bar.show(share); };
  BagRecording bag = read_bag(arguments.recording, options, diagnostics);
  RecordingToLocalize recording;
  choose_poses(arguments, options, bag, recording);
  compare_frames(arguments.recording, bag,
                 recording.poses.name != "true" || !recording.other.poses.empty(), diagnostics);
  recording.reads = std::move(bag.reads);
  recording.overview = overview_of(recording.reads);
  recording.truth = std::move(bag.truth);
  recording.path_length_m = driven_path(recording.truth, recording.poses.poses);
  recording.duration_s = bag.duration_s;
  return recording;
}

}  // namespace tagfield
