// SPDX-License-Identifier: Apache-2.0
/// @file
/// The schemas and channels that are met in a file.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "adapters/mcap/internal/records.h"
#include "adapters/mcap/internal/scan.h"

namespace tagfield::mcap_internal {

/// Records as they were met; of those with one id, the first.
class Definitions {
 public:
  /// Takes a schema or a channel. Gives null, or what is wrong with it. Throws Error, which does
  /// not name the file, where all take more than kMostMcapDefinitionBytes.
  const char* add(Op op, std::string_view content);

  /// Channels with their schemas, which may have come later. Gives the ids of channels that name a
  /// schema that there is not.
  [[nodiscard]] std::vector<McapChannelId> resolve(Contents& contents) const;

 private:
  std::map<std::uint16_t, std::string> schemas_;
  std::map<std::uint16_t, std::string> channels_;
  std::size_t bytes_ = 0;
};

}  // namespace tagfield::mcap_internal
