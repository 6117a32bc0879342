// SPDX-License-Identifier: Apache-2.0
#include "adapters/sqlite/table_counts.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <memory>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/base/file_kind.h"

namespace tagfield::sqlite {
namespace {

struct CloseCountedDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
using CountedDatabase = std::unique_ptr<sqlite3, CloseCountedDatabase>;

/// The first column of each row that a query gives.
std::vector<std::string> first_column(sqlite3* database, const std::string& path,
                                      const std::string& query) {
  std::vector<std::string> values;
  const auto take = [](void* to, int count, char** texts, char** /*names*/) {
    const char* const text = count > 0 ? texts[0] : nullptr;
    static_cast<std::vector<std::string>*>(to)->emplace_back(text == nullptr ? "" : text);
    return 0;
  };
  if (sqlite3_exec(database, query.c_str(), take, &values, nullptr) != SQLITE_OK) {
    fail({path, 0}, fmt::format("can't be read as a database: {}", sqlite3_errmsg(database)));
  }
  return values;
}

/// Without functions of the file, and without files beside it.
CountedDatabase opened(const std::string& path) {
  if (!is_file(path)) fail({path, 0}, "no such file");
  sqlite3* database = nullptr;
  const int result = sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READONLY, nullptr);
  CountedDatabase owned(database);
  if (result != SQLITE_OK) fail({path, 0}, "can't be opened");
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  first_column(database, path, "PRAGMA locking_mode=EXCLUSIVE");
  return owned;
}

}  // namespace

std::map<std::string, std::int64_t> table_counts(const std::string& path) {
  const CountedDatabase database = opened(path);
  const std::vector<std::string> found =
      first_column(database.get(), path, "PRAGMA quick_check(1)");
  if (found != std::vector<std::string>{"ok"}) {
    fail({path, 0}, "is damaged: " + (found.empty() ? std::string("no answer") : found.front()));
  }
  std::map<std::string, std::int64_t> counts;
  const char* const all =
      "SELECT name FROM sqlite_master WHERE type = 'table' AND rootpage > 0 ORDER BY name";
  for (const std::string& table : first_column(database.get(), path, all)) {
    std::string quoted;
    for (const char c : table) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
    const auto count =
        first_column(database.get(), path, fmt::format("SELECT count(*) FROM \"{}\"", quoted));
    counts[table] = std::stoll(count.at(0));
  }
  return counts;
}

}  // namespace tagfield::sqlite
