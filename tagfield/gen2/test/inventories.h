// SPDX-License-Identifier: Apache-2.0
/// @file
/// Inventories for tests.
#pragma once

#include <vector>

#include "tagfield/gen2/inventory.h"

namespace tagfield {

inline Time at(double seconds) { return time_from_seconds(seconds); }

/// Tags 0 to `count` - 1, all equally strong.
inline std::vector<TagOnAir> alike(int count, double decode_probability = 1.0) {
  std::vector<TagOnAir> tags;
  for (int tag = 0; tag < count; ++tag) {
    tags.push_back({static_cast<std::uint32_t>(tag), -50.0, decode_probability});
  }
  return tags;
}

inline InventorySettings fixed_q(int q) {
  InventorySettings settings;
  settings.adaptive_q = false;
  settings.start_q = q;
  return settings;
}

inline InventorySettings in_session(Session session) {
  InventorySettings settings;
  settings.session = session;
  return settings;
}

/// An inventory with its own tags.
struct InventoryBench {
  explicit InventoryBench(const InventorySettings& settings, std::uint64_t seed = 1,
                          std::uint64_t key = 1, const LinkSettings& link = {})
      : inventory(link, settings, memories, seed, key) {}

  /// The tags read up to `time`, in order.
  std::vector<std::uint32_t> read_until(double time) {
    std::vector<Singulation> out;
    inventory.run_until(at(time), out);
    std::vector<std::uint32_t> tags;
    for (const Singulation& read : out) tags.push_back(read.tag);
    return tags;
  }

  TagMemories memories;
  Inventory inventory;
};

inline std::int64_t slots(const InventoryCounts& counts) {
  return counts.empty + counts.read + counts.failed + counts.captured + counts.collided;
}

inline bool operator==(const Singulation& a, const Singulation& b) {
  return a.tag == b.tag && a.stamp == b.stamp;
}

}  // namespace tagfield
