// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/driven_robot.h"

#include <fmt/format.h>

namespace tagfield {

void let_be_driven(const std::string& robot, Scenario& scenario, Diagnostics& diagnostics) {
  const bool has_others = scenario.robots.size() > 1;
  scenario.driven_robot = robot;
  if (scenario.pose.source == PoseSource::kSlam) {
    scenario.pose.source = PoseSource::kOdometry;
    if (!has_others) return;
    diagnostics.warn(fmt::format(
        "while '{}' is driven no robot maps: the others rely on their wheel odometry, too", robot));
  } else if (scenario.pose.source == PoseSource::kNoisy) {
    diagnostics.warn(fmt::format(
        "pose.source: noisy has no effect on '{}', which is driven and relies on its wheel "
        "odometry{}",
        robot,
        has_others ? "; that error of the others' poses is not in the expected errors" : ""));
  }
}

}  // namespace tagfield
