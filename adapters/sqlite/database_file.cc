// SPDX-License-Identifier: Apache-2.0
#include "adapters/sqlite/database_file.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <cmath>
#include <map>
#include <utility>

#include "tagfield/base/error.h"

namespace tagfield::sqlite {
namespace {

struct CloseDatabase {
  void operator()(sqlite3* database) const { sqlite3_close(database); }
};
struct DropStatement {
  void operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }
};
using Statement = std::unique_ptr<sqlite3_stmt, DropStatement>;

/// Quotes the name of a table or column for SQL, whatever its characters.
std::string quoted(const std::string& name) {
  std::string text = "\"";
  for (const char c : name) {
    if (c == '"') text += '"';
    text += c;
  }
  return text + "\"";
}

std::string quoted_list(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + quoted(name);
  return text;
}

/// Binds a cell to a parameter of a statement. Returns SQLite's result.
int bind_cell(sqlite3_stmt* statement, int place, const Cell& cell) {
  switch (cell.kind) {
    case Cell::Kind::kWhole:
      return sqlite3_bind_int64(statement, place, cell.whole);
    case Cell::Kind::kNumber:
      if (!std::isfinite(cell.number)) break;
      return sqlite3_bind_double(statement, place, cell.number);
    case Cell::Kind::kText:
      return sqlite3_bind_text64(statement, place, cell.text.data(), cell.text.size(), nullptr,
                                 SQLITE_UTF8);
    case Cell::Kind::kUnknown:
      break;
  }
  return sqlite3_bind_null(statement, place);
}

}  // namespace

struct DatabaseFile::Parts {
  std::string named;
  std::unique_ptr<sqlite3, CloseDatabase> database;
  std::map<std::string, Statement> insertions;  ///< By table; dropped before the database.

  [[noreturn]] void fail_to_write() const {
    fail({named, 0}, fmt::format("can't be written: {}", sqlite3_errmsg(database.get())));
  }

  void run(const std::string& statement) const {
    if (sqlite3_exec(database.get(), statement.c_str(), nullptr, nullptr, nullptr) != SQLITE_OK) {
      fail_to_write();
    }
  }

  [[nodiscard]] Statement prepared(const std::string& text) const {
    sqlite3_stmt* statement = nullptr;
    if (sqlite3_prepare_v2(database.get(), text.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
      fail_to_write();
    }
    return Statement(statement);
  }
};

bool is_built_in() { return true; }

DatabaseFile::DatabaseFile(const std::string& path, std::string named)
    : parts_(std::make_unique<Parts>()) {
  parts_->named = std::move(named);
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(path.c_str(), &database, SQLITE_OPEN_READWRITE | SQLITE_OPEN_CREATE, nullptr);
  parts_->database.reset(database);
  if (result != SQLITE_OK) parts_->fail_to_write();
  // One transaction to a file that nobody uses yet: a journal would be useless.
  parts_->run("PRAGMA journal_mode=OFF");
  parts_->run("PRAGMA synchronous=OFF");
  parts_->run("BEGIN");
}

DatabaseFile::~DatabaseFile() = default;

void DatabaseFile::add_table(const TableForm& form, const std::vector<std::string>& key) {
  parts_->run(fmt::format("CREATE TABLE {} ({}, PRIMARY KEY ({})) WITHOUT ROWID", quoted(form.name),
                          quoted_list(form.columns), quoted_list(key)));
  std::string places;
  for (std::size_t i = 0; i < form.columns.size(); ++i) places += i == 0 ? "?" : ", ?";
  parts_->insertions[form.name] =
      parts_->prepared(fmt::format("INSERT INTO {} VALUES ({})", quoted(form.name), places));
}

void DatabaseFile::add_row(const std::string& table, const std::vector<Cell>& cells) {
  sqlite3_stmt* const statement = parts_->insertions.at(table).get();
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (bind_cell(statement, static_cast<int>(i) + 1, cells[i]) != SQLITE_OK) {
      parts_->fail_to_write();
    }
  }
  if (sqlite3_step(statement) != SQLITE_DONE) parts_->fail_to_write();
  sqlite3_reset(statement);
}

void DatabaseFile::run(const std::string& statement) { parts_->run(statement); }

void DatabaseFile::finish() {
  parts_->run("COMMIT");
  parts_->insertions.clear();
  if (sqlite3_close(parts_->database.get()) != SQLITE_OK) parts_->fail_to_write();
  static_cast<void>(parts_->database.release());
}

}  // namespace tagfield::sqlite
