// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization from more reads than fit in memory, in parts of a few tags each.
#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/localization/locate.h"

namespace tagfield {

/// Reads in parts, each with all reads of its tags.
struct ReadParts {
  std::size_t count = 1;
  std::function<std::vector<TagRead>(std::size_t part)> reads;
};

/// Merges the warnings of parts: those that differ only in numbers become one, with the text of the
/// first.
class WarningsOfParts {
 public:
  explicit WarningsOfParts(std::size_t parts) : parts_(parts) {}
  void take(const Diagnostics& of_part);
  void give(Diagnostics& diagnostics) const;

 private:
  std::size_t parts_;
  std::vector<std::string> order_;
  std::map<std::string, std::pair<std::string, std::size_t>> said_;  ///< Text, number of parts.
};

/// Locates each part's tags as locate_tags() would without any others. A tag in several parts, such
/// as a reference tag, gets the estimate of the first part. "auto" chooses per part; `method` is
/// "auto" if the choices differ. There are no corrected poses, since they would differ between
/// parts.
LocalizationResult locate_in_parts(const ReadParts& parts, const std::vector<AntennaPose>& poses,
                                   const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
