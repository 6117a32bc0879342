// SPDX-License-Identifier: Apache-2.0
/// @file
/// The schemas and channels found in a file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "adapters/mcap/internal/records.h"
#include "adapters/mcap/internal/scan.h"

namespace tagfield::mcap_internal {

/// Records in the order found; of several with the same id, the first counts.
class Definitions {
 public:
  /// Adds a schema or a channel. Returns null, or what is wrong with it. Throws Error, which does
  /// not name the file, if together they exceed kMaxMcapDefinitionBytes.
  const char* add(Op op, std::string_view content);

  /// Links channels to their schemas, which may follow them in the file. Returns the ids of
  /// channels whose schema is missing.
  [[nodiscard]] std::vector<McapChannelId> resolve(Contents& contents) const;

 private:
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::string> channels_;
  std::size_t bytes_ = 0;
};

}  // namespace tagfield::mcap_internal
