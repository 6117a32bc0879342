// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/late_tags.h"

#include <fmt/format.h>

namespace tagfield {

void warn_of_late_tags(const Scenario& scenario, double end_s, Diagnostics& diagnostics) {
  const Time end = time_from_seconds(end_s);
  const TagSpec* first = nullptr;
  std::size_t count = 0;
  for (const TagSpec& tag : scenario.tags) {
    if (tag.appears <= end) continue;
    if (first == nullptr) first = &tag;
    ++count;
  }
  if (first == nullptr) return;
  const double at_s = to_seconds(first->appears);
  diagnostics.warn(
      first->location,
      count == 1
          ? fmt::format("tag '{}' appears at {:g} s, after the run's end at {:g} s: it is not read",
                        first->id, at_s, end_s)
          : fmt::format(
                "{} tags appear after the run's end at {:g} s, such as '{}' at {:g} s: they "
                "are not read",
                count, end_s, first->id, at_s));
}

void warn_of_late_kidnappings(const Scenario& scenario, double end_s, Diagnostics& diagnostics) {
  for (const RobotSpec& robot : scenario.robots) {
    for (const Kidnapping& kidnapping : robot.kidnapped) {
      const double at_s = to_seconds(kidnapping.when);
      if (at_s <= end_s) continue;
      diagnostics.warn(
          kidnapping.location,
          fmt::format("robot '{}' would be kidnapped at {:g} s, after the run's end at "
                      "{:g} s: it is not",
                      robot.name, at_s, end_s));
    }
  }
}

}  // namespace tagfield
