#include "simulator/tag_table.h"

#include "tagfield/stream/csv.h"

namespace tagfield {

std::vector<TagSpec> read_tag_table(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t tag = table.column("tag");
  const std::size_t x = table.column("x_m");
  const std::size_t y = table.column("y_m");
  const std::size_t z = table.column("z_m");
  std::vector<TagSpec> tags;
  tags.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    const Eigen::Vector3d position(table.number(row, x), table.number(row, y),
                                   table.number(row, z));
    TagSpec spec;
    spec.id = table.text(row, tag);
    spec.motion = {{Time{}, from_translation(position)}};
    spec.location = {path, row.line};
    tags.push_back(std::move(spec));
  }
  return tags;
}

}  // namespace tagfield
