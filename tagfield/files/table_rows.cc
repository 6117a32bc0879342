#include "tagfield/files/table_rows.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/files/csv.h"

namespace tagfield {
namespace {

/// A cell as a field of CSV.
struct CellText {
  std::string operator()(std::monostate) const { return ""; }
  std::string operator()(std::int64_t number) const { return fmt::format("{}", number); }
  std::string operator()(double number) const {
    return std::isfinite(number) ? fmt::format("{}", number) : "";
  }
  std::string operator()(const std::string& text) const { return csv_field(text); }
};

}  // namespace

std::string csv_header(const TableForm& form) {
  std::string line;
  for (const std::string& column : form.columns) {
    line += (line.empty() ? "" : ",") + csv_field(column);
  }
  return line + "\n";
}

std::string csv_row(const std::vector<Cell>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) line += ",";
    line += std::visit(CellText{}, cells[i]);
  }
  return line + "\n";
}

}  // namespace tagfield
