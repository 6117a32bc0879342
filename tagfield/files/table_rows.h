// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables as rows of cells, whatever they are written as.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace tagfield {

/// What stands in a row and column: nothing known, a whole number, a number, or text.
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
  double number = 0.0;  ///< Where it is not finite, it is written as what is not known.
  std::string text;
};

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
