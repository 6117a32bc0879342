// SPDX-License-Identifier: Apache-2.0
/// @file
/// The result of an inventory: which tags are read, by whom, and how soon.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

/// What one reader, or one antenna, read.
struct InventoryShare {
  std::string name;
  std::string reader;  ///< That an antenna belongs to; of a reader its own name.
  double tags = 0.0;   ///< Read at least once.
  double only = 0.0;   ///< Of these, read by no other of the kind.
  double reads = 0.0;
};

/// How much of another zone a reader reads.
struct CrossRead {
  std::string reader;
  double tags = 0.0;
  double reads = 0.0;
};

/// The tags of one zone.
struct ZoneInventory {
  std::string zone;
  std::vector<std::string> readers;  ///< That it is meant for.
  std::size_t tags = 0;
  double read = 0.0;             ///< By anyone.
  double read_by_own = 0.0;      ///< By a reader that it is meant for.
  double crossed = 0.0;          ///< Read by a reader that it is not meant for.
  std::vector<CrossRead> cross;  ///< By those readers.
};

/// The tags between two heights.
struct LevelInventory {
  double low_m = 0.0;
  double high_m = 0.0;
  std::size_t tags = 0;
  double read = 0.0;
};

struct InventoryMoment {
  double time_s = 0.0;
  double share = 0.0;  ///< Of all tags, read by then at least once.
};

/// When a share of all tags had been read.
struct ReachedShare {
  double share = 0.0;
  std::optional<double> time_s;  ///< None where it was not reached in every run.
};

/// What it costs to do without one antenna.
struct InventoryWithout {
  std::string antenna;
  double read = 0.0;  ///< Tags read without it, the mean over the same seeds.
};

/// One run, or the mean of several: counts are then means, too.
struct InventorySummary {
  std::size_t tags = 0;
  double duration_s = 0.0;
  double read = 0.0;  ///< Tags read at least once.
  double reads = 0.0;
  double least_read = 0.0;  ///< Of the runs; the same as `read` of one.
  double most_read = 0.0;
  std::optional<double> median_reads;  ///< Of a tag that was read.
  std::vector<ReachedShare> reached;   ///< 50, 95 and 99 %.
  std::vector<InventoryMoment> curve;  ///< Of the first run; time and share do not fall.
  std::vector<InventoryShare> readers;
  std::vector<InventoryShare> antennas;
  std::vector<ZoneInventory> zones;
  std::vector<LevelInventory> levels;     ///< From the lowest.
  std::vector<InventoryWithout> without;  ///< Each antenna in turn; empty where that was not asked.
};

/// Share of all tags that were read; 0 of none.
double share_of(double part, std::size_t tags);

/// The mean of several runs of one scenario; at least one.
InventorySummary mean_of(const std::vector<InventorySummary>& runs);

}  // namespace tagfield
