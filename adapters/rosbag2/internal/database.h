// SPDX-License-Identifier: Apache-2.0
/// @file
/// Read-only access to untrusted SQLite databases.
#pragma once

#include <sqlite3.h>

#include <cstdint>
#include <memory>
#include <string>
#include <string_view>

namespace tagfield::rosbag2_internal {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct CloseStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};

/// Results of a query, row by row.
class Rows {
 public:
  explicit Rows(sqlite3_stmt* statement) : statement_(statement) {}

  /// Advances to the next row; returns whether there is one. If not, is_broken() tells whether that
  /// is due to an error.
  bool next();
  [[nodiscard]] bool is_broken() const { return is_broken_; }

  [[nodiscard]] std::int64_t number(int column) const;
  /// Empty if NULL. Valid until the next row.
  [[nodiscard]] std::string_view bytes(int column) const;
  [[nodiscard]] bool is_blob(int column) const;

 private:
  std::unique_ptr<sqlite3_stmt, CloseStatement> statement_;
  bool is_broken_ = false;
};

class Database {
 public:
  /// Never writes anything, not even files beside the database. In write-ahead mode, PATH-wal is
  /// part of the database. A truncated file is read as far as it goes. Throws Error if there is no
  /// such file.
  explicit Database(const std::string& path);

  /// Bytes of the file and of its write-ahead log.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Whether it has a table of that name: not a view or virtual table, which could be endless.
  [[nodiscard]] bool has_table(const std::string& name) const;
  /// Throws Error "PATH: …" if the query is invalid, such as for a missing column.
  [[nodiscard]] Rows rows(const std::string& query) const;
  /// SQLite's last error message.
  [[nodiscard]] std::string complaint() const { return sqlite3_errmsg(database_.get()); }

 private:
  std::string path_;
  std::uint64_t size_ = 0;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
};

}  // namespace tagfield::rosbag2_internal
