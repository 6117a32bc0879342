// SPDX-License-Identifier: Apache-2.0
#include "adapters/bags/bag_recording.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string_view>
#include <utility>

#include "adapters/bags/bag_content.h"
#include "adapters/bags/bag_structure.h"
#include "adapters/bags/bag_sweep.h"
#include "adapters/bags/bag_transforms.h"
#include "adapters/bags/held_reads.h"
#include "adapters/bags/ros2_sweep.h"
#include "adapters/rosbag2/recording_files.h"

namespace tagfield {
namespace {

const UnitNames kReadNames = {"the carrier of a read", "the phase of a read", "reads", ""};

template <typename Stamped>
void sort_by_stamp(std::vector<Stamped>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Stamped& a, const Stamped& b) { return a.stamp < b.stamp; });
}

/// In a list sorted by stamp, drops all but the first of those with the same stamp and key; returns
/// how many were dropped.
template <typename Stamped, typename KeyOf>
std::size_t keep_first(std::vector<Stamped>& list, const KeyOf& key_of) {
  std::vector<char> repeats(list.size(), 0);
  std::set<decltype(key_of(list.front()))> seen;  // At the current stamp.
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (i == 0 || list[i].stamp != list[i - 1].stamp) seen.clear();
    repeats[i] = seen.insert(key_of(list[i])).second ? 0 : 1;
  }
  std::size_t kept = 0;
  for (std::size_t i = 0; i < list.size(); ++i) {
    if (repeats[i] != 0) continue;
    if (kept != i) list[kept] = std::move(list[i]);
    ++kept;
  }
  const std::size_t dropped = list.size() - kept;
  list.erase(list.end() - static_cast<std::ptrdiff_t>(dropped), list.end());
  return dropped;
}

std::string_view antenna_of(const AntennaPose& pose) { return pose.antenna; }

template <typename OfTag>  // TagRead or TrueDistance
std::pair<std::string_view, std::string_view> antenna_and_tag(const OfTag& of_tag) {
  return {of_tag.antenna, of_tag.tag};
}

/// Sorted reads without duplicates.
std::vector<TagRead> tidy_reads(std::vector<TagRead> reads, const std::string& path,
                                Diagnostics& diagnostics) {
  sort_by_stamp(reads);
  const std::size_t repeats = keep_first(reads, antenna_and_tag<TagRead>);
  if (repeats > 0) {
    diagnostics.warn(
        {path, 0},
        fmt::format("{} reads repeat the stamp, antenna and tag of another; only the first counts",
                    repeats));
  }
  return reads;
}

bool same_pose(const RigidTransform& a, const RigidTransform& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

/// Sorted poses without duplicates.
std::vector<AntennaPose> ordered_poses(std::vector<AntennaPose> poses) {
  sort_by_stamp(poses);
  keep_first(poses, antenna_of);
  return poses;
}

/// Sorted poses without duplicates, with only one row for what never moved.
std::vector<AntennaPose> tidy_poses(std::vector<AntennaPose> unordered) {
  const std::vector<AntennaPose> poses = ordered_poses(std::move(unordered));
  std::map<std::string, const AntennaPose*> first;
  std::set<std::string> moved;
  for (const AntennaPose& pose : poses) {
    const auto entry = first.emplace(pose.antenna, &pose).first;
    if (!same_pose(entry->second->X_WA, pose.X_WA)) moved.insert(pose.antenna);
  }
  std::set<std::string> seen;
  std::vector<AntennaPose> tidy;
  for (const AntennaPose& pose : poses) {
    const bool is_first = seen.insert(pose.antenna).second;
    if (is_first || moved.count(pose.antenna) > 0) tidy.push_back(pose);
  }
  return tidy;
}

/// One row per tag, and another for each time that it moved.
std::vector<TagPosition> changes_of(std::vector<TagPosition> positions) {
  sort_by_stamp(positions);
  std::map<std::string, Eigen::Vector3d> last;
  std::vector<TagPosition> changes;
  for (TagPosition& position : positions) {
    const auto [entry, is_new] = last.emplace(position.tag, position.p_WT);
    if (!is_new && entry->second == position.p_WT) continue;
    entry->second = position.p_WT;
    changes.push_back(std::move(position));
  }
  return changes;
}

Truth tidy_truth(Truth truth) {
  // All of them, even at rest: a replay updates the antennas at these stamps.
  truth.antenna_poses = ordered_poses(std::move(truth.antenna_poses));
  truth.robot_poses = tidy_poses(std::move(truth.robot_poses));
  truth.tag_positions = changes_of(std::move(truth.tag_positions));
  sort_by_stamp(truth.distances);
  keep_first(truth.distances, antenna_and_tag<TrueDistance>);
  return truth;
}

double duration_of(const BagContent& content) {
  Time first = Time::max();
  Time last = Time::min();
  const auto look_at = [&](const auto& list) {
    for (const auto& element : list) {
      first = std::min(first, element.stamp);
      last = std::max(last, element.stamp);
    }
  };
  look_at(content.updates);
  look_at(content.truth.antenna_poses);
  look_at(content.truth.robot_poses);
  return first > last ? 0.0 : to_seconds(last - first);
}

/// Adds the true pose of antennas that tf doesn't know and that never moved.
void add_fixed_antennas(const BagRecording& recording, std::vector<AntennaPose>& poses) {
  std::map<std::string, std::size_t> rows;
  std::set<std::string> known;
  const std::vector<AntennaPose> truth = tidy_poses(recording.truth.antenna_poses);
  for (const AntennaPose& pose : truth) ++rows[pose.antenna];
  for (const AntennaPose& pose : poses) known.insert(pose.antenna);
  for (const AntennaPose& pose : truth) {
    if (rows[pose.antenna] == 1 && known.count(pose.antenna) == 0) poses.push_back(pose);
  }
}

bool is_truth_enough(const BagOptions& options, const BagRecording& recording) {
  return recording.unreported &&
         recording.unreported->overview.count > options.max_reads_believed &&
         !recording.truth.antenna_poses.empty();
}

PoseSet believed_of(const std::string& path, BagContent& content, const BagOptions& options,
                    const BagRecording& recording) {
  if (is_truth_enough(options, recording)) return {};
  if (!content.given_poses.empty()) {
    return {"given", content.truth_frame, tidy_poses(std::move(content.given_poses))};
  }
  sort_by_stamp(content.updates);
  keep_first(content.updates,
             [](const RecordedUpdate& update) -> std::string_view { return update.antenna; });
  TransformedPoses found;
  try {
    found = poses_from_transforms(std::move(content.transforms), content.updates, options.frames);
  } catch (const Error& error) {
    fail({path, 0}, error.what());
  }
  if (!found.poses.empty() && found.frame == recording.truth_frame) {
    add_fixed_antennas(recording, found.poses);
  }
  return {found.source, found.frame, tidy_poses(std::move(found.poses))};
}

void warn_of_unused_frequency(const std::string& path, Diagnostics& diagnostics) {
  diagnostics.warn({path, 0}, "--frequency has no effect: its reads state their carriers");
}

GoThrough going_through(const std::string& path, std::optional<double> frequency_hz,
                        Diagnostics& diagnostics) {
  const std::string decompressor = decompressor_of(path);
  if (!decompressor.empty()) {
    fail({path, 0},
         fmt::format("is compressed as a whole: decompress it first ({} {})", decompressor, path));
  }
  if (is_ros2_recording(path)) {
    if (frequency_hz) warn_of_unused_frequency(path, diagnostics);
    return [files = std::make_shared<Ros2Files>(path, diagnostics)](
               const BagReadSink& sink, const std::function<void(double)>& on_progress,
               Diagnostics& of_this_time) {
      return sweep_ros2(*files, sink, on_progress, of_this_time);
    };
  }
  require_whole_bag(path, diagnostics);
  return
      [path, frequency_hz](const BagReadSink& sink, const std::function<void(double)>& on_progress,
                           Diagnostics& of_this_time) {
        return sweep_bag(path, frequency_hz, sink, on_progress, of_this_time);
      };
}

}  // namespace

BagRecording read_bag(const std::string& path, const BagOptions& options,
                      Diagnostics& diagnostics) {
  HeldReads held(options.max_reads);
  const BagReadSink sink = held.sink();
  const GoThrough go_through = going_through(path, options.frequency_hz, diagnostics);
  BagContent content = go_through(sink, options.on_progress, diagnostics);
  held.units().tell(path, kReadNames, diagnostics);
  BagRecording recording;
  held.give(content, recording);
  if (held.overview()) recording.unreported = unreported_reads(path, go_through, held);
  recording.duration_s = duration_of(content);
  recording.reads = tidy_reads(std::move(recording.reads), path, diagnostics);
  recording.truth = tidy_truth(std::move(content.truth));
  recording.truth_frame = content.truth_frame;
  recording.believed = believed_of(path, content, options, recording);
  return recording;
}

}  // namespace tagfield
