// SPDX-License-Identifier: Apache-2.0
#include "adapters/sqlite/database_file.h"

#include <gtest/gtest.h>
#include <sqlite3.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>

#include "adapters/sqlite/table_counts.h"
#include "tagfield/base/error.h"

namespace tagfield::sqlite {
namespace {

namespace fs = std::filesystem;

/// Provides a temporary folder for the test.
class DatabaseFileTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / "tagfield_database_file_test";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  /// Writes a table whose name and columns need quoting in SQL.
  [[nodiscard]] std::string written(const std::string& name) const {
    DatabaseFile file(path(name), name);
    file.add_table({"odd \"table\"", {"key", "select", "a.b"}}, {"key"});
    file.add_row("odd \"table\"",
                 {Cell(std::int64_t{-3}), Cell(0.1), Cell(std::string("x'; DROP TABLE y --"))});
    file.add_row("odd \"table\"",
                 {Cell(std::int64_t{4}), Cell(std::numeric_limits<double>::infinity()), Cell()});
    file.finish();
    return path(name);
  }

  fs::path folder_;
};

std::string bytes_of(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Each row of a query as its columns and their types, as read by SQLite itself.
std::vector<std::string> rows_of(const std::string& path, const std::string& query) {
  std::vector<std::string> rows;
  sqlite3* database = nullptr;
  EXPECT_EQ(sqlite3_open(path.c_str(), &database), SQLITE_OK);
  const auto take = [](void* to, int count, char** values, char**) {
    std::string row;
    for (int i = 0; i < count; ++i) row += std::string(values[i] ? values[i] : "null") + "|";
    static_cast<std::vector<std::string>*>(to)->push_back(row);
    return 0;
  };
  EXPECT_EQ(sqlite3_exec(database, query.c_str(), take, &rows, nullptr), SQLITE_OK)
      << sqlite3_errmsg(database);
  sqlite3_close(database);
  return rows;
}

TEST_F(DatabaseFileTest, SqliteReadsWhatWasWritten) {
  const std::string file = written("a.sqlite");
  EXPECT_EQ(rows_of(file, "PRAGMA integrity_check"), (std::vector<std::string>{"ok|"}));
  EXPECT_EQ(rows_of(file, R"(SELECT key, typeof(key), "select" = 0.1, typeof("select"), "a.b"
                             FROM "odd ""table""")"),
            (std::vector<std::string>{"-3|integer|1|real|x'; DROP TABLE y --|",
                                      "4|integer|null|null|null|"}));
}

TEST_F(DatabaseFileTest, SameRowsMakeTheSameBytes) {
  EXPECT_EQ(bytes_of(written("a.sqlite")), bytes_of(written("b.sqlite")));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 2) << "a journal is left";
}

TEST_F(DatabaseFileTest, CountsRowsOfTables) {
  const std::string file = written("a.sqlite");
  EXPECT_EQ(table_counts(file), (std::map<std::string, std::int64_t>{{"odd \"table\"", 2}}));
  EXPECT_EQ(std::distance(fs::directory_iterator(folder_), {}), 1) << "a file is left beside it";
}

TEST_F(DatabaseFileTest, RefusesToCountWhatIsNoDatabase) {
  EXPECT_THROW(table_counts(path("none.sqlite")), Error);
  std::ofstream(path("text.sqlite")) << "point,rung\n1,2\n";
  EXPECT_THROW(table_counts(path("text.sqlite")), Error);
  const std::string file = written("cut.sqlite");
  fs::resize_file(file, fs::file_size(file) / 2);
  EXPECT_THROW(table_counts(file), Error);
}

TEST_F(DatabaseFileTest, RefusesTheSameKeyTwice) {
  DatabaseFile file(path("a.sqlite"), "results.sqlite");
  file.add_table({"t", {"key"}}, {"key"});
  file.add_row("t", {Cell(std::int64_t{1})});
  EXPECT_THROW(file.add_row("t", {Cell(std::int64_t{1})}), Error);
}

TEST_F(DatabaseFileTest, NamesTheFileThatCannotBeWritten) {
  try {
    const DatabaseFile file(path("no/such/folder"), "results.sqlite");
    FAIL() << "no complaint";
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()).rfind("results.sqlite: can't be written", 0), 0U)
        << error.what();
  }
}

}  // namespace
}  // namespace tagfield::sqlite
