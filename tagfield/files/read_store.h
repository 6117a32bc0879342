// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads that don't fit in memory, on the disk in parts that do.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <unordered_map>
#include <vector>

#include "tagfield/files/read_overview.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// Which tags are kept together. All reads of a tag are in one part.
struct PartPlan {
  std::size_t count = 1;                              ///< Of parts.
  std::unordered_map<std::string, std::size_t> part;  ///< By tag; of others every part has a copy.
};

/// Parts are few enough to have a file each.
inline constexpr std::size_t kMostParts = 800;

/// Tags one after the other, as they were first read, so that neighbours are together, until a part
/// has `reads_of_part` reads, or more where parts would be over kMostParts. Tags of `everywhere`,
/// which all parts need, are not counted.
PartPlan plan_parts(const ReadOverview& overview, std::size_t reads_of_part,
                    const std::set<std::string>& everywhere);

/// Reads in files without names in a folder, so that they vanish however the program ends: 56 bytes
/// a read.
class ReadStore {
 public:
  /// Throws Error naming the folder if no file can be made there.
  ReadStore(std::filesystem::path folder, PartPlan plan);
  ~ReadStore();
  ReadStore(const ReadStore&) = delete;
  ReadStore& operator=(const ReadStore&) = delete;

  /// Throws Error naming the folder if its disk is full.
  void add(const TagRead& read);

  [[nodiscard]] std::size_t parts() const;

  /// The reads of a part, those that all parts have first, each in the order in which they were
  /// added; of a tag with over `most_of_a_tag` reads every second, third, … Throws Error if they
  /// can't be read back.
  [[nodiscard]] std::vector<TagRead> part(std::size_t index, std::size_t most_of_a_tag);

 private:
  struct Record;
  struct PartFile;
  class Names;
  void flush(PartFile& file) const;
  /// All that a file has, in order.
  void for_each(PartFile& file, const std::function<void(const Record&)>& take) const;
  [[nodiscard]] TagRead read_of(const Record& record) const;
  void append(PartFile& file, std::size_t most_of_a_tag, std::vector<TagRead>& reads);

  std::filesystem::path folder_;
  PartPlan plan_;
  std::vector<std::unique_ptr<PartFile>> files_;  ///< The last one is everywhere's.
  std::unique_ptr<Names> tags_, antennas_, readers_;
};

}  // namespace tagfield
