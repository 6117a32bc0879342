// SPDX-License-Identifier: Apache-2.0
/// @file
/// How many rows the tables of an SQLite file have.
#pragma once

#include <cstdint>
#include <map>
#include <string>

namespace tagfield::sqlite {

/// Rows of each table of a database, by the table's name, after SQLite's check that the file is
/// intact. Views and virtual tables are left out. Writes nothing, not even beside the file. Throws
/// Error "PATH: …" if it is no database or a damaged one, or without SQLite.
std::map<std::string, std::int64_t> table_counts(const std::string& path);

}  // namespace tagfield::sqlite
