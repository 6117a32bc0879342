// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables as rows of cells, independent of the file format.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tagfield {

/// The content of a cell: unknown, a whole number, a number, or text.
struct Cell {
  enum class Kind { kUnknown, kWhole, kNumber, kText };

  Cell() = default;
  explicit Cell(std::int64_t value) : kind(Kind::kWhole), whole(value) {}
  explicit Cell(double value) : kind(Kind::kNumber), number(value) {}
  explicit Cell(std::string value) : kind(Kind::kText), text(std::move(value)) {}
  explicit Cell(const std::optional<double>& value)
      : kind(value ? Kind::kNumber : Kind::kUnknown), number(value.value_or(0.0)) {}

  Kind kind = Kind::kUnknown;
  std::int64_t whole = 0;
  double number = 0.0;  ///< Written as unknown if it is not finite.
  std::string text;
};

/// Name and columns of a table.
struct TableForm {
  std::string name;
  std::vector<std::string> columns;
};

/// A header line, including the line end.
std::string csv_header(const TableForm& form);
/// A row, including the line end: numbers are exact to the last bit, unknown values are empty.
std::string csv_row(const std::vector<Cell>& cells);

}  // namespace tagfield
