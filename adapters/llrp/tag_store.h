// SPDX-License-Identifier: Apache-2.0
/// @file
/// The memories of all tags of a world, as its readers read and write them.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "adapters/llrp/specs.h"
#include "tagfield/gen2/memory_banks.h"

namespace tagfield::llrp {

/// Shared by all readers of a world; for the thread that simulates.
class TagStore {
 public:
  /// The tag's memory: an EPC for its ID at first.
  MemoryBanks& of(const std::string& id);

 private:
  std::map<std::string, MemoryBanks> tags_;
};

/// Writes what came of `op` on the tag as its OpSpecResult.
void operate(const OpSpec& op, MemoryBanks& tag, ByteWriter& result);

/// Whether the tag is one of those that the mask means.
bool is_meant(const MemoryMask& mask, const MemoryBanks& tag);
/// Whether Selects let it take part.
bool is_selected(const std::vector<TagFilter>& filters, const MemoryBanks& tag);

}  // namespace tagfield::llrp
