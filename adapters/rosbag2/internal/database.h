// SPDX-License-Identifier: Apache-2.0
/// @file
/// Databases of others through SQLite, read alone, and trusted in nothing.
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

/// A query, row after row.
class Rows {
 public:
  explicit Rows(sqlite3_stmt* statement) : statement_(statement) {}

  /// Goes to the next row; whether there is one. Where not, is_broken() tells whether there should.
  bool next();
  [[nodiscard]] bool is_broken() const { return is_broken_; }

  [[nodiscard]] std::int64_t number(int column) const;
  /// Empty where it is NULL. Holds until the next row.
  [[nodiscard]] std::string_view bytes(int column) const;
  [[nodiscard]] bool is_blob(int column) const;

 private:
  std::unique_ptr<sqlite3_stmt, CloseStatement> statement_;
  bool is_broken_ = false;
};

class Database {
 public:
  /// Nothing is ever written, beside the file neither. What a file in write-ahead mode has in
  /// PATH-wal belongs to it. Of a file that was cut off what is there is read. Throws Error where
  /// there is no such file.
  explicit Database(const std::string& path);

  /// Bytes of the file, and of what belongs to it.
  [[nodiscard]] std::uint64_t size() const { return size_; }
  /// Whether it has a table of that name: no view and nothing virtual, which could be endless.
  [[nodiscard]] bool has_table(const std::string& name) const;
  /// Throws Error "PATH: …" where the query can't be, as for a column that is not there.
  [[nodiscard]] Rows rows(const std::string& query) const;
  /// What SQLite complained of last.
  [[nodiscard]] std::string complaint() const { return sqlite3_errmsg(database_.get()); }

 private:
  std::string path_;
  std::uint64_t size_ = 0;
  std::unique_ptr<sqlite3, CloseDatabase> database_;
};

}  // namespace tagfield::rosbag2_internal
