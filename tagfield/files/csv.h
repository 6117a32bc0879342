// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables as CSV files (RFC 4180, with a header line or without). Every error message names file
/// and line.
#pragma once

#include <Eigen/Core>
#include <array>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/time.h"

namespace tagfield {

/// A line of a table.
struct CsvRow {
  int line = 0;  ///< In the file, 1-based.
  std::vector<std::string> fields;
};

/// A table in memory. Each row has as many fields as the header.
struct CsvTable {
  std::string file;
  std::vector<std::string> header;
  std::vector<CsvRow> rows;

  /// Index of the column `name`. Throws Error, which lists the columns, if it is missing.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[nodiscard]] bool has_column(std::string_view name) const;
  /// Finite number in a field; throws Error "FILE:LINE: …" on anything else.
  [[nodiscard]] double number(const CsvRow& row, std::size_t column) const;
  /// Same, for a length or a coordinate in a unit of `metres`: [m], within ±1000 km.
  [[nodiscard]] double length(const CsvRow& row, std::size_t column, double metres = 1.0) const;
  /// Indices of the columns x_m, y_m, z_m.
  [[nodiscard]] std::array<std::size_t, 3> position_columns() const;
  /// The three coordinates of a position [m]; throws as length().
  [[nodiscard]] Eigen::Vector3d position(const CsvRow& row,
                                         const std::array<std::size_t, 3>& columns) const;
  /// Stamp in a field, in seconds (see parse_stamp).
  [[nodiscard]] Time stamp(const CsvRow& row, std::size_t column) const;
  /// Text in a field that must not be empty.
  [[nodiscard]] const std::string& text(const CsvRow& row, std::size_t column) const;
};

/// Format of a table.
struct CsvForm {
  char delimiter = ',';
  bool header = true;  ///< If false, the columns are named "1", "2", …
};

/// Reads a table. Columns can be in any order, and there can be more than needed; blank lines are
/// skipped. Throws Error if the file can't be read, is empty, is not text, or has a line with more
/// or fewer fields than the header (or, without one, than the first line).
CsvTable read_csv(const std::string& path, const CsvForm& form = {});

/// Same, row by row, for files that don't fit in memory: `begin` receives the table without rows,
/// `take` each row, whose fields are valid until it returns. When an error is thrown, the rows
/// before the bad line have been passed. `on_progress`, if given, is called regularly with the
/// share of the file that has been read.
void read_csv_rows(const std::string& path, const std::function<void(const CsvTable&)>& begin,
                   const std::function<void(const CsvRow&)>& take, const CsvForm& form = {},
                   const std::function<void(double)>& on_progress = {});

/// `text` as one field, quoted if necessary.
std::string csv_field(std::string_view text);

}  // namespace tagfield
