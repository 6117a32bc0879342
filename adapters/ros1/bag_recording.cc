// SPDX-License-Identifier: Apache-2.0
#include "adapters/ros1/bag_recording.h"

#include <console_bridge/console.h>
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

#include "adapters/ros1/bag_content.h"
#include "adapters/ros1/bag_structure.h"
#include "adapters/ros1/bag_sweep.h"
#include "adapters/ros1/bag_transforms.h"
#include "adapters/ros1/ros2_sweep.h"
#include "adapters/rosbag2/recording_files.h"
#include "tagfield/base/units.h"

namespace tagfield {
namespace {

/// rosbag and tf2 print their complaints; here they come as exceptions or are looked for.
class Silence {
 public:
  Silence() { console_bridge::noOutputHandler(); }
  ~Silence() { console_bridge::restorePreviousOutputHandler(); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;
};

template <typename Stamped>
void sort_by_stamp(std::vector<Stamped>& list) {
  std::stable_sort(list.begin(), list.end(),
                   [](const Stamped& a, const Stamped& b) { return a.stamp < b.stamp; });
}

/// Drops all but the first of those with the same key; how many that were.
template <typename Element, typename KeyOf>
std::size_t keep_first(std::vector<Element>& list, const KeyOf& key_of) {
  std::set<decltype(key_of(list.front()))> seen;
  const std::size_t before = list.size();
  const auto is_repeat = [&](const Element& element) {
    return !seen.insert(key_of(element)).second;
  };
  list.erase(std::remove_if(list.begin(), list.end(), is_repeat), list.end());
  return before - list.size();
}

/// Sorted, each read once, phases wrapped.
std::vector<TagRead> tidy_reads(std::vector<TagRead> reads, const std::string& path,
                                Diagnostics& diagnostics) {
  for (TagRead& read : reads) read.phase_rad = wrap_to_two_pi(read.phase_rad);
  sort_by_stamp(reads);
  const std::size_t repeats = keep_first(
      reads, [](const TagRead& read) { return std::tuple(read.stamp, read.antenna, read.tag); });
  if (repeats > 0) {
    diagnostics.warn({path, 0}, fmt::format("{} reads repeat the stamp, antenna and tag of "
                                            "another, of which the first counts",
                                            repeats));
  }
  return reads;
}

bool same_pose(const RigidTransform& a, const RigidTransform& b) {
  return a.translation == b.translation && a.rotation.coeffs() == b.rotation.coeffs();
}

/// Sorted, each stamp once.
std::vector<AntennaPose> ordered_poses(std::vector<AntennaPose> poses) {
  sort_by_stamp(poses);
  keep_first(poses, [](const AntennaPose& pose) { return std::tuple(pose.stamp, pose.antenna); });
  return poses;
}

/// Ordered, and one row of whoever never moved.
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

/// A row for each tag, and one for each time that it moved.
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
  // All of them, also at rest: a replay updates the antennas at these stamps.
  truth.antenna_poses = ordered_poses(std::move(truth.antenna_poses));
  truth.robot_poses = tidy_poses(std::move(truth.robot_poses));
  truth.tag_positions = changes_of(std::move(truth.tag_positions));
  sort_by_stamp(truth.distances);
  keep_first(truth.distances, [](const TrueDistance& distance) {
    return std::tuple(distance.stamp, distance.antenna, distance.tag);
  });
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

/// Gives antennas that tf doesn't know, and that never moved, their true place.
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

PoseSet believed_of(BagContent& content, const BagOptions& options, const BagRecording& recording) {
  if (!content.given_poses.empty()) {
    return {"given", content.truth_frame, tidy_poses(std::move(content.given_poses))};
  }
  sort_by_stamp(content.updates);
  keep_first(content.updates,
             [](const RecordedUpdate& update) { return std::tuple(update.stamp, update.antenna); });
  TransformedPoses found =
      poses_from_transforms(std::move(content.transforms), content.updates, options.frames);
  if (!found.poses.empty() && found.frame == recording.truth_frame) {
    add_fixed_antennas(recording, found.poses);
  }
  return {found.source, found.frame, tidy_poses(std::move(found.poses))};
}

BagContent content_of(const std::string& path, const BagOptions& options,
                      Diagnostics& diagnostics) {
  if (is_ros2_recording(path)) return sweep_ros2(path, options.on_progress, diagnostics);
  require_whole_bag(path);
  return sweep_bag(path, options.frequency_hz, options.on_progress, diagnostics);
}

}  // namespace

BagRecording read_bag(const std::string& path, const BagOptions& options,
                      Diagnostics& diagnostics) {
  const Silence silence;
  BagContent content = content_of(path, options, diagnostics);
  BagRecording recording;
  recording.duration_s = duration_of(content);
  recording.reads = tidy_reads(std::move(content.reads), path, diagnostics);
  recording.truth = tidy_truth(std::move(content.truth));
  recording.truth_frame = content.truth_frame;
  recording.believed = believed_of(content, options, recording);
  return recording;
}

}  // namespace tagfield
