// SPDX-License-Identifier: Apache-2.0
/// @file
/// When the tags of a scenario appear and disappear.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "tagfield/scenario/scenario.h"

namespace tagfield {

/// Returns what is due, earliest first; at equal times in the scenario's order.
class TagSchedule {
 public:
  /// Throws Error if two tags have the same ID.
  explicit TagSchedule(const std::vector<TagSpec>& tags);

  /// The next tag to appear by `until`; none if none is left.
  std::optional<TagSpec> next_to_appear(Time until);
  /// ID of the next tag to disappear by `until`.
  std::optional<std::string> next_to_disappear(Time until);

 private:
  std::vector<TagSpec> to_appear_;                          ///< Latest first.
  std::vector<std::pair<Time, std::string>> to_disappear_;  ///< Latest first.
};

}  // namespace tagfield
