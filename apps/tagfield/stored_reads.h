// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables of more reads than fit in memory.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/experiment/in_parts.h"
#include "tagfield/files/read_store.h"

namespace tagfield {

/// Tables from this size on are not held in memory [bytes]: about five million reads, which take
/// 1.5 GB and more while they are localized.
inline constexpr std::uintmax_t kLargeTable = 400'000'000;
/// Reads of tables from this size on are not kept in memory beside what is made of them [bytes].
inline constexpr std::uintmax_t kTableToReadAnew = 100'000'000;
/// Reads of a part, and the most of one tag.
inline constexpr std::size_t kReadsOfPart = 250'000;

/// Adds `--part-reads`.
void add_part_option(CLI::App& command, std::optional<std::size_t>& part_reads);

/// So many reads a part that a table is to be held in; none where it is held in memory as a whole.
/// `part_reads`: as on the command line; throws Error where it is told of a pipe.
std::optional<std::size_t> part_of_table(const std::string& table,
                                         std::optional<std::size_t> part_reads);

/// Whether a table is a file from kTableToReadAnew on.
bool is_read_anew(const std::string& table);

/// Throws Error where a table has other reads when it is read again.
void require_same_count(const std::string& table, std::size_t at_first, std::size_t again);

struct StoredReads {
  std::string table;  ///< File.
  ReadOverview overview;
  std::unique_ptr<ReadStore> store;
  std::size_t most_of_a_tag = kReadsOfPart;
};

/// Reads the table twice, with a progress bar each: all complaints come at the first. The store is
/// in the innermost folder on the way to `out` that exists. Warns of tags of which not all reads
/// will count. Throws Error as read_reads_csv() and ReadStore do.
StoredReads store_reads(const std::string& table, const std::string& out, std::size_t part_reads,
                        const std::set<std::string>& everywhere, Diagnostics& diagnostics);

/// Its parts, as they come from the disk. `reads` must outlive them.
ReadParts parts_of(const StoredReads& reads, const std::optional<Calibration>& calibration);

}  // namespace tagfield
