// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which tags of a scenario come and go, and when.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Hands out what is due, the earliest first; of one time in the scenario's order.
class TagSchedule {
 public:
  /// Throws Error if two tags have one ID.
  explicit TagSchedule(const std::vector<TagSpec>& tags);

  /// The next tag to appear by `until`; none where there is none left.
  std::optional<TagSpec> next_to_appear(Time until);
  /// ID of the next tag to disappear by `until`.
  std::optional<std::string> next_to_disappear(Time until);

 private:
  std::vector<TagSpec> to_appear_;                          ///< Latest first.
  std::vector<std::pair<Time, std::string>> to_disappear_;  ///< Likewise.
};

}  // namespace tagfield
