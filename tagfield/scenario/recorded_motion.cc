// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/recorded_motion.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

#include "tagfield/files/csv.h"
#include "tagfield/files/poses_csv.h"

namespace tagfield {
namespace {

/// A tag's rows, without those that repeat the previous position, so that a stationary tag has one
/// row.
struct RecordedTag {
  std::string id;
  Trajectory motion;
  Location first_row;
};

void add_row(RecordedTag& tag, const StampedPose& pose) {
  if (tag.motion.empty() || tag.motion.back().X_WB.translation != pose.X_WB.translation) {
    tag.motion.push_back(pose);
  }
}

/// In order of first occurrence.
std::vector<RecordedTag> read_recorded_tags(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t stamp = table.column("stamp_s");
  const std::size_t tag = table.column("tag");
  const auto xyz = table.position_columns();
  std::vector<RecordedTag> tags;
  std::unordered_map<std::string, std::size_t> places;
  std::unordered_map<std::string, Time> last_stamps;
  for (const CsvRow& row : table.rows) {
    const std::string& id = table.text(row, tag);
    const Time at = table.stamp(row, stamp);
    const auto [place, is_new] = places.emplace(id, tags.size());
    if (is_new) tags.push_back({id, {}, {path, row.line}});
    if (!is_new && at <= last_stamps[id]) {
      fail({path, row.line}, fmt::format("stamps of tag '{}' must rise from row to row", id));
    }
    last_stamps[id] = at;
    add_row(tags[place->second], {at, from_translation(table.position(row, xyz))});
  }
  return tags;
}

void replay(const RecordedTag& recorded, TagSpec& tag) {
  // The table contains positions only, no orientations.
  const bool is_turned = tag.on.empty() && !tag.motion.empty();
  const Eigen::Quaterniond R_WT =
      is_turned ? tag.motion.front().X_WB.rotation : Eigen::Quaterniond::Identity();
  tag.id = recorded.id;
  tag.on.clear();
  tag.motion = recorded.motion;
  for (StampedPose& pose : tag.motion) pose.X_WB.rotation = R_WT;
  tag.in_steps = true;
  tag.appears = recorded.motion.front().stamp;
}

}  // namespace

Trajectory read_recorded_antenna(const std::string& path, const std::string& antenna) {
  Trajectory trajectory;
  for (const AntennaPose& pose : read_poses_csv(path)) {
    if (pose.antenna == antenna) trajectory.push_back({pose.stamp, pose.X_WA});
  }
  if (trajectory.empty()) fail({path, 0}, fmt::format("has no poses of antenna '{}'", antenna));
  try {
    require_rising_stamps(trajectory);
  } catch (const Error& error) {
    fail({path, 0}, fmt::format("antenna '{}': {}", antenna, error.what()));
  }
  return trajectory;
}

void replay_tags(const std::string& path, std::vector<TagSpec>& tags) {
  std::unordered_map<std::string, std::size_t> places;
  for (std::size_t i = 0; i < tags.size(); ++i) places.emplace(tags[i].id, i);
  for (const RecordedTag& recorded : read_recorded_tags(path)) {
    const auto [place, is_new] = places.emplace(recorded.id, tags.size());
    if (is_new) tags.emplace_back().location = recorded.first_row;
    replay(recorded, tags[place->second]);
  }
}

std::optional<Time> end_of_recordings(const std::vector<AntennaSpec>& antennas) {
  std::optional<Time> end;
  for (const AntennaSpec& antenna : antennas) {
    if (antenna.recorded.empty()) continue;
    end = std::max(end.value_or(Time::min()), antenna.recorded.back().stamp);
  }
  return end;
}

}  // namespace tagfield
