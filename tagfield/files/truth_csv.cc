#include "tagfield/files/truth_csv.h"

#include <fmt/format.h>

#include <iterator>

#include "tagfield/files/csv.h"
#include "tagfield/files/poses_csv.h"

namespace tagfield {
namespace {

std::string tags_to_csv(const std::vector<TagPosition>& positions) {
  std::string text = "stamp_s,tag,x_m,y_m,z_m\n";
  const auto out = std::back_inserter(text);
  for (const TagPosition& position : positions) {
    const Eigen::Vector3d& p = position.p_WT;
    fmt::format_to(out, "{},{},{},{},{}\n", format_stamp(position.stamp), csv_field(position.tag),
                   p.x(), p.y(), p.z());
  }
  return text;
}

std::string distances_to_csv(const std::vector<TrueDistance>& distances) {
  std::string text = "stamp_s,antenna,tag,distance_m\n";
  const auto out = std::back_inserter(text);
  for (const TrueDistance& distance : distances) {
    fmt::format_to(out, "{},{},{},{}\n", format_stamp(distance.stamp), csv_field(distance.antenna),
                   csv_field(distance.tag), distance.distance_m);
  }
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

void stage_truth(const Truth& truth, StagedFolder& folder) {
  folder.add("truth/antenna_poses.csv", poses_to_csv(truth.antenna_poses));
  folder.add("truth/robot_poses.csv", poses_to_csv(truth.robot_poses, "robot"));
  folder.add("truth/tags.csv", tags_to_csv(truth.tag_positions));
  folder.add("truth/distances.csv", distances_to_csv(truth.distances));
}

Truth read_truth(const std::string& run_folder) {
  Truth truth;
  truth.antenna_poses = read_poses_csv(run_folder + "/truth/antenna_poses.csv");
  truth.robot_poses = read_poses_csv(run_folder + "/truth/robot_poses.csv", "robot");
  truth.tag_positions = read_tags_csv(run_folder + "/truth/tags.csv");
  return truth;
}

}  // namespace tagfield
