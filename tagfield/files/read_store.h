// SPDX-License-Identifier: Apache-2.0
/// @file
/// Storage of reads that don't fit in memory, on disk in parts that do.
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

/// Assignment of tags to parts. All reads of a tag are in one part.
struct PartPlan {
  std::size_t count = 1;                              ///< Of parts.
  std::unordered_map<std::string, std::size_t> part;  ///< By tag; others are in every part.
};

/// Maximum number of parts, so that each can have an open file.
inline constexpr std::size_t kMaxParts = 800;

/// Assigns tags in order of their first reads, so that neighbours are together, until a part has
/// `reads_of_part` reads, or more if there would be over kMaxParts parts. Tags in `everywhere`,
/// which all parts need, are not counted.
PartPlan plan_parts(const ReadOverview& overview, std::size_t reads_of_part,
                    const std::set<std::string>& everywhere);

/// Reads in unnamed files in a folder, so that they vanish however the program ends: 56 bytes per
/// read.
class ReadStore {
 public:
  /// Throws Error naming the folder if no file can be created there.
  ReadStore(std::filesystem::path folder, PartPlan plan);
  ~ReadStore();
  ReadStore(const ReadStore&) = delete;
  ReadStore& operator=(const ReadStore&) = delete;

  /// Throws Error naming the folder if its disk is full.
  void add(const TagRead& read);

  [[nodiscard]] std::size_t parts() const;

  /// The reads of a part, beginning with those common to all parts, each in the order in which they
  /// were added; for a tag with more than `most_of_a_tag` reads, every second, third, … of them.
  /// Throws Error if they can't be read back.
  [[nodiscard]] std::vector<TagRead> part(std::size_t index, std::size_t most_of_a_tag);

 private:
  struct Record;
  struct PartFile;
  class Names;
  void flush(PartFile& file) const;
  /// Passes all records of a file to `take`, in order.
  void for_each(PartFile& file, const std::function<void(const Record&)>& take) const;
  [[nodiscard]] TagRead read_of(const Record& record) const;
  void append(PartFile& file, std::size_t most_of_a_tag, std::vector<TagRead>& reads);

  std::filesystem::path folder_;
  PartPlan plan_;
  std::vector<std::unique_ptr<PartFile>> files_;  ///< The last one is for tags common to all parts.
  std::unique_ptr<Names> tags_, antennas_, readers_;
};

}  // namespace tagfield
