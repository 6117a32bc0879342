// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization of more reads than fit in memory, in parts of some tags each.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/locate.h"

namespace tagfield {

/// Reads of whole tags, part after part.
struct ReadParts {
  std::size_t count = 1;
  std::function<std::vector<TagRead>(std::size_t part)> reads;
};

/// Warnings of parts: those that say the same but for numbers are one, in the words of the first.
class WarningsOfParts {
 public:
  explicit WarningsOfParts(std::size_t parts) : parts_(parts) {}
  void take(const Diagnostics& of_part);
  void give(Diagnostics& diagnostics) const;

 private:
  std::size_t parts_;
  std::vector<std::string> order_;
  std::map<std::string, std::pair<std::string, std::size_t>> said_;  ///< Text, by how many parts.
};

/// Locates each part's tags as locate_tags() locates them where there are no others. A tag that is
/// in several parts, such as a reference tag, has the first part's estimate. "auto" chooses for
/// each part; `method` is "auto" where it chose differently. There are no corrected poses, which
/// each part would have its own of.
LocalizationResult locate_in_parts(const ReadParts& parts, const std::vector<AntennaPose>& poses,
                                   const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
