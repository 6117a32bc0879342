// SPDX-License-Identifier: Apache-2.0
#include "adapters/rosbag2/internal/database.h"

#include <fmt/format.h>

#include <filesystem>

#include "adapters/rosbag2/internal/whole_pages.h"
#include "tagfield/base/error.h"

namespace tagfield::rosbag2_internal {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxBytes = 128 << 20;  ///< Per row.

void require_file(const std::string& path) {
  std::error_code error;
  const fs::file_status status = fs::status(path, error);
  if (!fs::exists(status)) fail({path, 0}, "no such file");
  if (!fs::is_regular_file(status)) fail({path, 0}, "is a folder or no file, expected a database");
}

/// Size of a file; 0 if there is none.
std::uint64_t bytes_of(const std::string& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  return error ? 0 : size;
}

std::string address_of(const std::string& path) {
  std::string address = "file:";
  for (const char c : fs::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    const bool is_plain = (byte >= '0' && byte <= '9') || (byte >= 'a' && byte <= 'z') ||
                          (byte >= 'A' && byte <= 'Z') || byte == '/';
    address += is_plain ? std::string(1, c) : fmt::format("%{:02x}", byte);
  }
  return address + "?mode=ro";
}

/// Disables views and functions from the file and limits sizes; allows files that are shorter than
/// stated, and partly corrupt schemas, to be read as far as possible.
void make_wary(sqlite3* database) {
  sqlite3_limit(database, SQLITE_LIMIT_LENGTH, kMaxBytes);
  sqlite3_db_config(database, SQLITE_DBCONFIG_ENABLE_VIEW, 0, nullptr);
  sqlite3_db_config(database, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  for (const char* setting :
       {"locking_mode=EXCLUSIVE", "cell_size_check=ON", "writable_schema=ON", "query_only=ON"}) {
    sqlite3_exec(database, fmt::format("PRAGMA {}", setting).c_str(), nullptr, nullptr, nullptr);
  }
}

}  // namespace

bool Rows::next() {
  const int result = sqlite3_step(statement_.get());
  is_broken_ = result != SQLITE_ROW && result != SQLITE_DONE;
  return result == SQLITE_ROW;
}

std::int64_t Rows::number(int column) const {
  return sqlite3_column_int64(statement_.get(), column);
}

std::string_view Rows::bytes(int column) const {
  const void* const bytes = sqlite3_column_blob(statement_.get(), column);
  if (bytes == nullptr) return {};
  return {static_cast<const char*>(bytes),
          static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

bool Rows::is_blob(int column) const {
  return sqlite3_column_type(statement_.get(), column) == SQLITE_BLOB;
}

Database::Database(const std::string& path) : path_(path) {
  require_file(path);
  size_ = bytes_of(path) + bytes_of(path + "-wal");
  sqlite3* database = nullptr;
  const int result =
      sqlite3_open_v2(address_of(path).c_str(), &database,
                      SQLITE_OPEN_READONLY | SQLITE_OPEN_URI | SQLITE_OPEN_NOMUTEX, whole_pages());
  database_.reset(database);
  if (result != SQLITE_OK) fail({path, 0}, fmt::format("can't be read: {}", complaint()));
  make_wary(database);
}

bool Database::has_table(const std::string& name) const {
  Rows found = rows(fmt::format(
      "SELECT 1 FROM sqlite_master WHERE type = 'table' AND rootpage > 0 AND name = '{}'", name));
  return found.next();
}

Rows Database::rows(const std::string& query) const {
  sqlite3_stmt* statement = nullptr;
  if (sqlite3_prepare_v2(database_.get(), query.c_str(), -1, &statement, nullptr) != SQLITE_OK) {
    fail({path_, 0}, fmt::format("is not a database of rosbag2, or a broken one: {}", complaint()));
  }
  return Rows(statement);
}

}  // namespace tagfield::rosbag2_internal
