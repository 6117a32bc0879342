// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/truth_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "tagfield/files/csv.h"
#include "tagfield/files/poses_csv.h"

namespace tagfield {

void append_row(const TagPosition& position, std::string& text) {
  const Eigen::Vector3d& p = position.p_WT;
  fmt::format_to(std::back_inserter(text), "{},{},{},{},{}\n", format_stamp(position.stamp),
                 csv_field(position.tag), p.x(), p.y(), p.z());
}

void append_row(const TrueDistance& distance, std::string& text) {
  fmt::format_to(std::back_inserter(text), "{},{},{},{}\n", format_stamp(distance.stamp),
                 csv_field(distance.antenna), csv_field(distance.tag), distance.distance_m);
}

namespace {

template <class Rows>
std::string table_of(const char* header, const Rows& rows) {
  std::string text = header;
  for (const auto& row : rows) append_row(row, text);
  return text;
}

std::vector<TagPosition> read_tags_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t stamp = table.column("stamp_s");
  const std::size_t tag = table.column("tag");
  const auto xyz = table.position_columns();
  std::vector<TagPosition> positions;
  positions.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    positions.push_back({table.stamp(row, stamp), table.text(row, tag), table.position(row, xyz)});
  }
  return positions;
}

}  // namespace

void stage_true_positions(const Truth& truth, StagedFolder& folder) {
  folder.add("truth/antenna_poses.csv", poses_to_csv(truth.antenna_poses));
  folder.add("truth/robot_poses.csv", poses_to_csv(truth.robot_poses, "robot"));
  folder.add("truth/tags.csv", table_of(kTagsHeader, truth.tag_positions));
}

void stage_truth(const Truth& truth, StagedFolder& folder) {
  stage_true_positions(truth, folder);
  folder.add(kDistancesFile, table_of(kDistancesHeader, truth.distances));
}

Truth read_truth(const std::string& run_folder) {
  Truth truth;
  truth.antenna_poses = read_poses_csv(run_folder + "/truth/antenna_poses.csv");
  truth.robot_poses = read_poses_csv(run_folder + "/truth/robot_poses.csv", "robot");
  truth.tag_positions = read_tags_csv(run_folder + "/truth/tags.csv");
  return truth;
}

}  // namespace tagfield
