// SPDX-License-Identifier: Apache-2.0
/// @file
/// Tables and recordings of more reads than fit in memory.
#pragma once

#include <CLI/CLI.hpp>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>

#include "adapters/bags/bag_recording.h"
#include "tagfield/base/error.h"
#include "tagfield/calibration/calibration.h"
#include "tagfield/experiment/in_parts.h"
#include "tagfield/files/read_store.h"

namespace tagfield {

/// Tables of at least this size are not held in memory [bytes]: about five million reads, which
/// take 1.5 GB and more during localization.
inline constexpr std::uintmax_t kLargeTable = 400'000'000;
/// Reads of tables of at least this size are not kept in memory beside the results [bytes].
inline constexpr std::uintmax_t kTableToReadAnew = 100'000'000;
/// Same, for ROS recordings [reads].
inline constexpr std::size_t kManyReads = 5'000'000;
inline constexpr std::size_t kReadsToReadAnew = 1'000'000;
/// Reads per part, and maximum per tag.
inline constexpr std::size_t kReadsOfPart = 250'000;

/// Adds `--part-reads`.
void add_part_option(CLI::App& command, std::optional<std::size_t>& part_reads);

/// Number of reads per part if a table is to be stored in parts; none if it is held in memory as a
/// whole. `part_reads`: as on the command line; throws Error if it is given for a pipe.
std::optional<std::size_t> part_of_table(const std::string& table,
                                         std::optional<std::size_t> part_reads);

/// Whether a table is a file of at least kTableToReadAnew.
bool is_read_anew(const std::string& table);

/// Reads that are read again each time they are needed.
struct ReadSource {
  std::string file;
  ReadOverview overview;
  /// Calls `take` with each read, and `on_progress` with 0 … 1. Throws Error if their number has
  /// changed.
  std::function<void(const std::function<void(const TagRead&)>& take,
                     const std::function<void(double)>& on_progress)>
      for_each;
};

/// Reads of a table, which is read once, with a progress bar, so that errors in its rows are
/// reported now. Throws Error and warns as read_reads_csv() does.
ReadSource reads_of_table(const std::string& table, Diagnostics& diagnostics);

/// Reads of a recording.
ReadSource reads_of_bag(const std::string& bag, const UnreportedReads& unreported);

struct StoredReads {
  ReadSource source;
  std::unique_ptr<ReadStore> store;
  std::size_t most_of_a_tag = kReadsOfPart;
};

/// Stores the reads, with a progress bar, in the innermost existing folder on the path to `out`.
/// Warns of tags of which not all reads will be used. Throws Error as the source and ReadStore do.
StoredReads store_reads(ReadSource source, const std::string& out, std::size_t part_reads,
                        const std::set<std::string>& everywhere, Diagnostics& diagnostics);

/// The parts, read from the disk one by one. `reads` must outlive them.
ReadParts parts_of(const StoredReads& reads, const std::optional<Calibration>& calibration);

}  // namespace tagfield
