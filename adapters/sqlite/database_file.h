// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables written to one SQLite file, independent of their contents.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/files/table_rows.h"

namespace tagfield::sqlite {

/// Whether this build has SQLite; without it the constructor throws.
bool is_built_in();

/// A database that is written once, from its first row to its last. The same rows yield the same
/// bytes with the same release of SQLite. The file is complete only after finish(), so write it to
/// a temporary path.
class DatabaseFile {
 public:
  /// Starts an empty file. Throws Error if it can't be written; `named` is its path in messages.
  DatabaseFile(const std::string& path, std::string named);
  ~DatabaseFile();
  DatabaseFile(const DatabaseFile&) = delete;
  DatabaseFile& operator=(const DatabaseFile&) = delete;

  /// Creates a table; a column can hold cells of any kind. `key`: columns of its primary key.
  void add_table(const TableForm& form, const std::vector<std::string>& key);
  /// Adds a row to an existing table, with as many cells as columns. Non-finite numbers become
  /// null.
  void add_row(const std::string& table, const std::vector<Cell>& cells);
  /// Runs a statement, such as one that creates a view.
  void run(const std::string& statement);
  /// Writes everything to the file. Throws Error if the disk is full.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tagfield::sqlite
