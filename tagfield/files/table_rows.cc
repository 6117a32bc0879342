// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/table_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

std::string field_of(const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::kUnknown:
      return "";
    case Cell::Kind::kWhole:
      return fmt::format("{}", cell.whole);
    case Cell::Kind::kNumber:
      return std::isfinite(cell.number) ? fmt::format("{}", cell.number) : "";
    case Cell::Kind::kText:
      return csv_field(cell.text);
  }
  return "";
}

}  // namespace

std::string csv_header(const TableForm& form) {
  std::string line;
  for (const std::string& column : form.columns) {
    if (!line.empty()) line += ',';
    line += csv_field(column);
  }
  line += '\n';
  return line;
}

std::string csv_row(const std::vector<Cell>& cells) {
  std::string line;
  bool is_first = true;
  for (const Cell& cell : cells) {
    if (!is_first) line += ',';
    is_first = false;
    line += field_of(cell);
  }
  line += '\n';
  return line;
}

}  // namespace tagfield
