// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables as CSV files (RFC 4180, with a header line or without). Every complaint names file and
/// line.
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

  /// Place of the column `name`. Throws Error with the columns there are.
  [[nodiscard]] std::size_t column(std::string_view name) const;
  [[nodiscard]] bool has_column(std::string_view name) const;
  /// Finite number in a field; throws Error "FILE:LINE: …" on anything else.
  [[nodiscard]] double number(const CsvRow& row, std::size_t column) const;
  /// The same of a length or a coordinate, in units of so many metres: [m], within ±1000 km.
  [[nodiscard]] double length(const CsvRow& row, std::size_t column, double metres = 1.0) const;
  /// Places of the columns x_m, y_m, z_m.
  [[nodiscard]] std::array<std::size_t, 3> position_columns() const;
  /// The three numbers of a place [m]; throws as length().
  [[nodiscard]] Eigen::Vector3d position(const CsvRow& row,
                                         const std::array<std::size_t, 3>& columns) const;
  /// Stamp in a field, in seconds (see parse_stamp).
  [[nodiscard]] Time stamp(const CsvRow& row, std::size_t column) const;
  /// Text in a field that must not be empty.
  [[nodiscard]] const std::string& text(const CsvRow& row, std::size_t column) const;
};

/// What a table looks like.
struct CsvForm {
  char delimiter = ',';
  bool header = true;  ///< Else the columns are called "1", "2", …
};

/// Reads a table. Columns may stand in any order and there may be more of them than one asks for;
/// blank lines are skipped. Throws Error if the file can't be read, is empty, is not text, or has a
/// line with more or fewer fields than the header (or, without one, than the first line).
CsvTable read_csv(const std::string& path, const CsvForm& form = {});

/// The same, row by row, of files that don't fit in memory: `begin` gets the table without rows,
/// `take` gets each row, whose fields are good until it returns. Rows before a bad line have been
/// taken when it throws. `on_progress`, where given, gets the share of the file that is done now
/// and then.
void read_csv_rows(const std::string& path, const std::function<void(const CsvTable&)>& begin,
                   const std::function<void(const CsvRow&)>& take, const CsvForm& form = {},
                   const std::function<void(double)>& on_progress = {});

/// `text` as one field: quoted where it must be.
std::string csv_field(std::string_view text);

}  // namespace tagfield
