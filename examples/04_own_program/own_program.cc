// SPDX-License-Identifier: Apache-2.0
// A custom program: tags appear and disappear while a robot drives, and are localized afterwards.
#include <cstdio>

#include "tagfield/localization/locate.h"
#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/recording.h"

namespace {

tagfield::TagSpec tag_at(const char* id, double x, double y, double z) {
  tagfield::TagSpec tag;
  tag.id = id;
  tag.motion = {{tagfield::Time{}, tagfield::from_translation({x, y, z})}};
  return tag;
}

tagfield::Scenario robot_with_antenna() {
  tagfield::Scenario scenario;
  tagfield::RobotSpec robot;
  robot.name = "robot";
  robot.waypoints = {{4.0, 0.0}, {4.0, 3.0}};
  scenario.robots = {robot};
  tagfield::AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.on = "robot";
  antenna.X_PA = tagfield::from_translation({0.0, 0.0, 1.2});
  scenario.antennas = {antenna};
  scenario.tags = {tag_at("first", 2.0, 2.5, 1.2)};
  return scenario;
}

}  // namespace

int main() {
  tagfield::Recording recording;
  tagfield::Simulation simulation(robot_with_antenna(), /*seed=*/1, recorded_in(recording));
  while (!simulation.finished()) {
    simulation.step();
    if (simulation.now() == tagfield::time_from_seconds(5.0)) {
      simulation.add_tag(tag_at("second", 1.0, -2.0, 1.2));
    }
  }
  tagfield::Diagnostics diagnostics;
  const tagfield::LocalizationResult result =
      tagfield::locate_tags(recording.reads, recording.believed_poses, {}, diagnostics);
  for (const tagfield::TagEstimate& estimate : result.estimates) {
    if (estimate.verdict == tagfield::Verdict::kLocated) {
      const Eigen::Vector3d& p = estimate.candidates.front().p_WT;
      std::printf("%s: %.3f %.3f m\n", estimate.tag.c_str(), p.x(), p.y());
    } else {
      std::printf("%s: %s\n", estimate.tag.c_str(), estimate.reason.c_str());
    }
  }
}
