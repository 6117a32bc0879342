// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/late_tags.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

using LateWarnings = std::vector<std::string>;

/// Warnings about tags that appear at these times, of a run of 10 s.
LateWarnings warnings_at(const std::vector<double>& appear_s) {
  Scenario scenario;
  for (const double at_s : appear_s) {
    TagSpec tag;
    tag.id = "t" + std::to_string(scenario.tags.size());
    tag.appears = time_from_seconds(at_s);
    tag.location = {"hall.yaml", 7};
    scenario.tags.push_back(tag);
  }
  Diagnostics diagnostics;
  warn_of_late_tags(scenario, 10.0, diagnostics);
  return diagnostics.warnings();
}

TEST(LateTags, OfTheRunAreNone) {
  EXPECT_EQ(warnings_at({}), LateWarnings{});
  EXPECT_EQ(warnings_at({0.0, 4.0, 10.0}), LateWarnings{});
}

TEST(LateTags, AreNamedOnce) {
  EXPECT_EQ(
      warnings_at({0.0, 10.01}),
      LateWarnings{"hall.yaml:7: tag 't1' appears at 10.01 s, after the run's end at 10 s: it is "
                   "not read"});
  EXPECT_EQ(
      warnings_at({20.0, 0.0, 30.0}),
      LateWarnings{"hall.yaml:7: 2 tags appear after the run's end at 10 s, such as 't0' at 20 "
                   "s: they are not read"});
}

TEST(LateKidnappings, AreEachNamed) {
  Scenario scenario;
  scenario.robots.resize(1);
  scenario.robots[0].name = "cart";
  for (const double at_s : {1.0, 10.0, 5000.0}) {
    scenario.robots[0].kidnapped.push_back({time_from_seconds(at_s), {}, {"hall.yaml", 3}});
  }
  Diagnostics diagnostics;
  warn_of_late_kidnappings(scenario, 10.0, diagnostics);
  EXPECT_EQ(diagnostics.warnings(),
            LateWarnings{"hall.yaml:3: robot 'cart' would be kidnapped at 5000 s, after the run's "
                         "end at 10 s: it is not"});
}

}  // namespace
}  // namespace tagfield
