// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/tag_positions_csv.h"

#include <fmt/format.h>

#include "tagfield/files/csv.h"

namespace tagfield {

std::string tag_positions_to_csv(const std::map<std::string, Eigen::Vector3d>& places) {
  std::string text = "tag,x_m,y_m,z_m\n";
  for (const auto& [tag, p] : places) {
    text += fmt::format("{},{},{},{}\n", csv_field(tag), p.x(), p.y(), p.z());
  }
  return text;
}

std::map<std::string, Eigen::Vector3d> read_tag_positions_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t tag = table.column("tag");
  const auto xyz = table.position_columns();
  std::map<std::string, Eigen::Vector3d> places;
  for (const CsvRow& row : table.rows) {
    if (!places.emplace(table.text(row, tag), table.position(row, xyz)).second) {
      fail({path, row.line}, fmt::format("tag '{}' is listed twice", row.fields[tag]));
    }
  }
  return places;
}

}  // namespace tagfield
