// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables into one file of SQLite. Knows nothing of what is in them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/files/table_rows.h"

namespace tagfield::sqlite {

/// Whether this build has SQLite; without it the constructor throws.
bool is_built_in();

/// A database that is written once, from its first row to its last. The same rows make the same
/// bytes with the same release of SQLite. Its file is whole after finish(), so write it where
/// nobody looks for it yet.
class DatabaseFile {
 public:
  /// Begins in an empty file. Throws Error where it can't be written; `named` is its path there.
  DatabaseFile(const std::string& path, std::string named);
  ~DatabaseFile();
  DatabaseFile(const DatabaseFile&) = delete;
  DatabaseFile& operator=(const DatabaseFile&) = delete;

  /// Makes a table; cells of a column can be of any kind. `key`: columns of its primary key.
  void add_table(const TableForm& form, const std::vector<std::string>& key);
  /// Adds a row to a table that was made, as long as its form. What is not finite is null.
  void add_row(const std::string& table, const std::vector<Cell>& cells);
  /// Runs a statement, such as one that makes a view.
  void run(const std::string& statement);
  /// Writes all to the file. Throws Error where the disk is full.
  void finish();

 private:
  struct Parts;
  std::unique_ptr<Parts> parts_;
};

}  // namespace tagfield::sqlite
