// SPDX-License-Identifier: Apache-2.0
/// @file
/// The kinds of tables (CSV) that Tagfield reads and writes, identified by their columns.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tagfield {

/// Words of a table's kind if it is one of reads.
inline constexpr const char* kTableOfReads = "reads";

/// The kind of a table, such as "reads", "estimates" or "order of tags". Throws Error, which lists
/// the columns, if they are those of no kind.
std::string kind_of_table(const std::string& path);

/// Contents of a table of any kind but reads, in the form of describe_checked_file(). Throws Error
/// "FILE:LINE: …" on invalid input, such as what is not a finite number where one belongs.
nlohmann::ordered_json describe_table_of(const std::string& kind, const std::string& path);

}  // namespace tagfield
