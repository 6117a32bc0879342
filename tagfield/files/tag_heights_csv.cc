// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/tag_heights_csv.h"

#include <fmt/format.h>

#include "tagfield/files/csv.h"

namespace tagfield {

std::string tag_heights_to_csv(const std::map<std::string, double>& heights) {
  std::string text = "tag,height_m\n";
  for (const auto& [tag, height] : heights) text += fmt::format("{},{}\n", csv_field(tag), height);
  return text;
}

std::map<std::string, double> read_tag_heights_csv(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t tag = table.column("tag");
  const std::size_t height = table.column("height_m");
  std::map<std::string, double> heights;
  for (const CsvRow& row : table.rows) {
    if (!heights.emplace(table.text(row, tag), table.length(row, height)).second) {
      fail({path, row.line}, fmt::format("tag '{}' is listed twice", row.fields[tag]));
    }
  }
  return heights;
}

}  // namespace tagfield
