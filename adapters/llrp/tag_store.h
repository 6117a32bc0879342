// SPDX-License-Identifier: Apache-2.0
/// @file
/// Memory of all tags of a world, which readers read and write.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "adapters/llrp/specs.h"
#include "tagfield/gen2/memory_banks.h"

namespace tagfield::llrp {

/// Shared by all readers of a world; to be used on the simulation thread only.
class TagStore {
 public:
  /// The tag's memory, which initially holds an EPC for its ID.
  MemoryBanks& of(const std::string& id);

 private:
  std::map<std::string, MemoryBanks> tags_;
};

/// Performs `op` on the tag and writes its OpSpecResult.
void operate(const OpSpec& op, MemoryBanks& tag, ByteWriter& result);

/// Whether the tag matches the mask.
bool is_meant(const MemoryMask& mask, const MemoryBanks& tag);
/// Whether the Selects let the tag take part.
bool is_selected(const std::vector<TagFilter>& filters, const MemoryBanks& tag);

}  // namespace tagfield::llrp
