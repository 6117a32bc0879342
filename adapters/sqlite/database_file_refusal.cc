// SPDX-License-Identifier: Apache-2.0
// Replaces database_file.cc and table_counts.cc in builds without SQLite.
#include "adapters/sqlite/database_file.h"
#include "adapters/sqlite/table_counts.h"
#include "tagfield/base/error.h"

namespace tagfield::sqlite {

struct DatabaseFile::Parts {};

bool is_built_in() { return false; }

DatabaseFile::DatabaseFile(const std::string& path, std::string named) {
  static_cast<void>(path);
  fail({std::move(named), 0}, "this tagfield was built without SQLite (libsqlite3-dev)");
}
DatabaseFile::~DatabaseFile() = default;
void DatabaseFile::add_table(const TableForm&, const std::vector<std::string>&) {}
void DatabaseFile::add_row(const std::string&, const std::vector<Cell>&) {}
void DatabaseFile::run(const std::string&) {}
void DatabaseFile::finish() {}

std::map<std::string, std::int64_t> table_counts(const std::string& path) {
  fail({path, 0}, "this tagfield was built without SQLite (libsqlite3-dev)");
}

}  // namespace tagfield::sqlite
