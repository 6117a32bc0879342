/// @file
/// Tables as rows of cells, whatever they are written as.
#pragma once

#include <cstdint>
#include <string>
#include <variant>
#include <vector>

namespace tagfield {

/// Nothing known, a whole number, a number (not finite: nothing known), or text.
using Cell = std::variant<std::monostate, std::int64_t, double, std::string>;

/// What a table looks like.
struct TableForm {
  std::string name;
  std::vector<std::string> columns;
};

/// A header line, with its end.
std::string csv_header(const TableForm& form);
/// A row, with its end: numbers so that they are read back to the last bit, nothing for what is
/// unknown.
std::string csv_row(const std::vector<Cell>& cells);

}  // namespace tagfield
