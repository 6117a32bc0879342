// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/internal/tag_schedule.h"

#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>

namespace tagfield {

TagSchedule::TagSchedule(const std::vector<TagSpec>& tags)
    : to_appear_(tags.rbegin(), tags.rend()) {
  std::unordered_map<std::string, Location> seen;
  for (const TagSpec& tag : tags) {
    const auto [first, is_new] = seen.emplace(tag.id, tag.location);
    if (!is_new) {
      fail(tag.location, fmt::format("a second tag has the ID '{}' (the first: {})", tag.id,
                                     to_string(first->second)));
    }
    if (tag.disappears) to_disappear_.emplace_back(*tag.disappears, tag.id);
  }
  std::stable_sort(to_appear_.begin(), to_appear_.end(),
                   [](const TagSpec& a, const TagSpec& b) { return a.appears > b.appears; });
  std::stable_sort(to_disappear_.begin(), to_disappear_.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
}

std::optional<TagSpec> TagSchedule::next_to_appear(Time until) {
  if (to_appear_.empty() || to_appear_.back().appears > until) return std::nullopt;
  TagSpec next = std::move(to_appear_.back());
  to_appear_.pop_back();
  return next;
}

std::optional<std::string> TagSchedule::next_to_disappear(Time until) {
  if (to_disappear_.empty() || to_disappear_.back().first > until) return std::nullopt;
  std::string next = std::move(to_disappear_.back().second);
  to_disappear_.pop_back();
  return next;
}

}  // namespace tagfield
