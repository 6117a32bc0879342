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

#include "adapters/ros1/bag_recording.h"
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
/// The same of recordings of ROS, whose reads are counted [reads].
inline constexpr std::size_t kManyReads = 5'000'000;
inline constexpr std::size_t kReadsToReadAnew = 1'000'000;
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

/// Reads that are gone through again each time that they are needed.
struct ReadSource {
  std::string file;
  ReadOverview overview;
  /// Calls `take` with each read, and `on_progress` with 0 … 1. Throws Error where they are not as
  /// many as at first.
  std::function<void(const std::function<void(const TagRead&)>& take,
                     const std::function<void(double)>& on_progress)>
      for_each;
};

/// Those of a table, which is gone through once, with a progress bar: complaints about its rows
/// come now. Throws Error as read_reads_csv() does.
ReadSource reads_of_table(const std::string& table);

/// Those of a recording.
ReadSource reads_of_bag(const std::string& bag, const UntoldReads& untold);

struct StoredReads {
  ReadSource source;
  std::unique_ptr<ReadStore> store;
  std::size_t most_of_a_tag = kReadsOfPart;
};

/// Goes through the reads, with a progress bar. The store is in the innermost folder on the way to
/// `out` that exists. Warns of tags of which not all reads will count. Throws Error as the source
/// and ReadStore do.
StoredReads store_reads(ReadSource source, const std::string& out, std::size_t part_reads,
                        const std::set<std::string>& everywhere, Diagnostics& diagnostics);

/// Its parts, as they come from the disk. `reads` must outlive them.
ReadParts parts_of(const StoredReads& reads, const std::optional<Calibration>& calibration);

}  // namespace tagfield
