#include "tagfield/scenario/internal/tag_table.h"

#include "tagfield/files/csv.h"

namespace tagfield {

std::vector<TagSpec> read_tag_table(const std::string& path) {
  const CsvTable table = read_csv(path);
  const std::size_t tag = table.column("tag");
  const auto xyz = table.position_columns();
  std::vector<TagSpec> tags;
  tags.reserve(table.rows.size());
  for (const CsvRow& row : table.rows) {
    TagSpec spec;
    spec.id = table.text(row, tag);
    spec.motion = {{Time{}, from_translation(table.position(row, xyz))}};
    spec.location = {path, row.line};
    tags.push_back(std::move(spec));
  }
  return tags;
}

}  // namespace tagfield
