// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <sqlite3.h>

#include <filesystem>
#include <set>

#include "adapters/rosbag2/recorded_file.h"
#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

constexpr const char* kTables =
    "CREATE TABLE topics(id INTEGER PRIMARY KEY, name TEXT NOT NULL, type TEXT NOT NULL,"
    " serialization_format TEXT NOT NULL, offered_qos_profiles TEXT NOT NULL);"
    "CREATE TABLE messages(id INTEGER PRIMARY KEY, topic_id INTEGER NOT NULL,"
    " timestamp INTEGER NOT NULL, data BLOB NOT NULL);"
    "CREATE INDEX timestamp_idx ON messages (timestamp ASC);"
    "INSERT INTO topics VALUES (1, '/a', 'pkg/msg/A', 'cdr', ''), (7, '/b', 'pkg/msg/B', 'cdr', "
    "'');";

/// A database being written.
struct Writing {
  explicit Writing(const std::string& path) {
    EXPECT_EQ(sqlite3_open(path.c_str(), &database), 0);
    run("PRAGMA journal_mode=MEMORY; PRAGMA synchronous=OFF");  // As in rosbag2.
  }
  ~Writing() { sqlite3_close(database); }
  Writing(const Writing&) = delete;
  Writing& operator=(const Writing&) = delete;
  void run(const std::string& statements) const {
    EXPECT_EQ(sqlite3_exec(database, statements.c_str(), nullptr, nullptr, nullptr), 0)
        << sqlite3_errmsg(database);
  }
  sqlite3* database = nullptr;
};

/// Message i has i % 300 bytes of i, on /a or /b in turn.
std::string bytes_of(std::size_t i) { return std::string(i % 300, static_cast<char>(i % 251)); }

void add_messages(const Writing& writing, std::size_t count) {
  writing.run("BEGIN");
  sqlite3_stmt* insert = nullptr;
  sqlite3_prepare_v2(writing.database, "INSERT INTO messages VALUES (NULL, ?, ?, ?)", -1, &insert,
                     nullptr);
  for (std::size_t i = 0; i < count; ++i) {
    const std::string bytes = bytes_of(i);
    sqlite3_bind_int64(insert, 1, i % 2 == 0 ? 1 : 7);
    sqlite3_bind_int64(insert, 2, static_cast<std::int64_t>(i));
    sqlite3_bind_blob(insert, 3, bytes.data(), static_cast<int>(bytes.size()), SQLITE_TRANSIENT);
    EXPECT_EQ(sqlite3_step(insert), SQLITE_DONE);
    sqlite3_reset(insert);
  }
  sqlite3_finalize(insert);
  writing.run("COMMIT");
}

std::string database_of(const TemporaryFolder& folder, std::size_t count) {
  const std::string path = folder.file("run.db3");
  const Writing writing(path);
  writing.run(kTables);
  add_messages(writing, count);
  return path;
}

struct Found {
  std::vector<std::pair<std::string, std::string>> messages;  ///< Topic and bytes.
  std::vector<std::string> warnings;
};

Found read_all(const std::string& path) {
  Diagnostics diagnostics;
  Found found;
  const auto file = open_recorded_database(path, diagnostics);
  const std::vector<char> all(file->topics().size(), 1);
  const auto take = [&](std::size_t topic, std::string_view bytes, double share) {
    found.messages.emplace_back(file->topics().at(topic).name, bytes);
    EXPECT_GE(share, 0.0);
    EXPECT_LE(share, 1.0);
  };
  file->read(all, take, diagnostics);
  found.warnings = diagnostics.warnings();
  return found;
}

/// Number of messages, from the first on, that are as written.
std::size_t right_ones(const Found& found) {
  for (std::size_t i = 0; i < found.messages.size(); ++i) {
    const auto expected =
        std::pair<std::string, std::string>(i % 2 == 0 ? "/a" : "/b", bytes_of(i));
    if (found.messages[i] != expected) return i;
  }
  return found.messages.size();
}

TEST(RecordedDatabase, GivesTopicsAndMessagesInOrder) {
  const TemporaryFolder folder;
  const std::string path = database_of(folder, 2000);
  Diagnostics diagnostics;
  const auto topics = open_recorded_database(path, diagnostics)->topics();
  ASSERT_EQ(topics.size(), 2U);
  EXPECT_EQ(topics[1].name, "/b");
  EXPECT_EQ(topics[1].type, "pkg/msg/B");
  EXPECT_EQ(topics[1].encoding, "cdr");
  const Found found = read_all(path);
  EXPECT_EQ(found.messages.size(), 2000U);
  EXPECT_EQ(right_ones(found), 2000U);
  EXPECT_TRUE(found.warnings.empty());
  EXPECT_EQ(folder.names(), std::set<std::string>{"run.db3"}) << "nothing is made beside it";
}

TEST(RecordedDatabase, NamesOfFilesMayBeAnything) {
  const TemporaryFolder folder;
  const std::string odd = folder.file("a ?b#c%41ö&mode=rwc.db3");
  fs::rename(database_of(folder, 5), odd);
  EXPECT_EQ(right_ones(read_all(odd)), 5U);
}

TEST(RecordedDatabase, WhatIsOnlyInTheWriteAheadLogIsThereToo) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.db3");
  {
    const Writing writing(path);
    writing.run("PRAGMA journal_mode=WAL; PRAGMA wal_autocheckpoint=0");
    writing.run(kTables);
    add_messages(writing, 1000);
    // As left by a recorder that is killed now.
    fs::create_directory(folder.path() / "killed");
    fs::copy(path, folder.path() / "killed/run.db3");
    fs::copy(path + "-wal", folder.path() / "killed/run.db3-wal");
  }
  const Found found = read_all(folder.file("killed/run.db3"));
  EXPECT_EQ(right_ones(found), 1000U);
  EXPECT_TRUE(fs::exists(folder.path() / "killed/run.db3-wal"));
  EXPECT_FALSE(fs::exists(folder.path() / "killed/run.db3-shm"));
}

TEST(RecordedDatabase, CutOffIsReadAsFarAsItGoes) {
  const TemporaryFolder folder;
  const std::string path = database_of(folder, 3000);
  const auto size = static_cast<double>(fs::file_size(path));
  for (double share = 0.999; share > 0.4; share -= 0.0037) {
    fs::resize_file(path, static_cast<std::uintmax_t>(size * share));
    const Found found = read_all(path);
    EXPECT_EQ(right_ones(found), found.messages.size()) << share;
    EXPECT_GT(static_cast<double>(found.messages.size()), 3000.0 * (share - 0.15));
    ASSERT_FALSE(found.warnings.empty()) << share;
    EXPECT_TRUE(contains(found.warnings.back(), "is cut off or broken after"));
  }
}

TEST(RecordedDatabase, WhatIsNoneIsRefused) {
  const TemporaryFolder folder;
  Diagnostics diagnostics;
  const auto complaint = [&](const std::string& path) {
    return error_of([&] { open_recorded_database(path, diagnostics); });
  };
  EXPECT_EQ(complaint(folder.file("gone.db3")), folder.file("gone.db3") + ": no such file");
  EXPECT_TRUE(contains(complaint(folder.path().string()), "is a folder or no file"));
  EXPECT_TRUE(contains(complaint(folder.with("empty.db3", "")), "no table 'topics'"));
  EXPECT_TRUE(contains(complaint(folder.with("text.db3", std::string(9000, 'x'))),
                       "is not a database of rosbag2, or a broken one"));
  const std::string other = folder.file("other.db3");
  Writing(other).run("CREATE TABLE topics(id INTEGER PRIMARY KEY, name); CREATE TABLE messages(a)");
  EXPECT_TRUE(contains(complaint(other), "no such column: type"));
}

TEST(RecordedDatabase, EndlessOnesAreRefused) {
  const TemporaryFolder folder;
  const std::string path = folder.file("run.db3");
  Writing(path).run(
      "CREATE TABLE topics(id INTEGER PRIMARY KEY, name, type, serialization_format);"
      "CREATE VIEW messages AS WITH RECURSIVE n(i) AS (SELECT 1 UNION ALL SELECT i + 1 FROM n)"
      " SELECT i AS topic_id, x'00' AS data FROM n");
  Diagnostics diagnostics;
  EXPECT_TRUE(contains(error_of([&] { open_recorded_database(path, diagnostics); }),
                       "no table 'messages'"));
}

TEST(RecordedDatabase, RowsWithoutSenseAreLeftOut) {
  const TemporaryFolder folder;
  const std::string path = database_of(folder, 4);
  Writing(path).run(
      "INSERT INTO messages VALUES (90, 3, 0, x'01'), (91, 1, 0, 'text'), (92, 1, 0, 5);");
  const Found found = read_all(path);
  EXPECT_EQ(right_ones(found), 4U);
  EXPECT_EQ(found.messages.size(), 4U);
  EXPECT_EQ(found.warnings.size(), 1U);
}

RC_GTEST_PROP(RecordedDatabase, AnyBytesDoNoHarm, ()) {
  const TemporaryFolder folder;
  const std::string path = database_of(folder, 200);
  std::string bytes = folder.text_of("run.db3");
  const int changes = *rc::gen::element(1, 5, 200);
  for (int i = 0; i < changes; ++i) {
    // Damage near the roots of the B-trees has the greatest effect.
    const auto most = *rc::gen::element<std::size_t>(bytes.size(), 5000);
    bytes[*rc::gen::inRange<std::size_t>(0, std::min(most, bytes.size()))] =
        *rc::gen::arbitrary<char>();
  }
  (void)folder.with("run.db3", bytes);
  try {
    RC_ASSERT(read_all(path).messages.size() <= bytes.size());
  } catch (const Error&) {
    RC_SUCCEED("refused");
  }
}

}  // namespace
}  // namespace tagfield
