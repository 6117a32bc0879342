// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/moment.h"

#include <fmt/format.h>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

void plan(RobotSpec& robot, Diagnostics& diagnostics) {
  for (const PlanarPose& goal : robot.goals_W) robot.waypoints.push_back(position_of(goal));
  robot.goals_W.clear();
  const bool is_unknown = robot.random_goals > 0 || !robot.kidnapped.empty();
  robot.random_goals = 0;
  robot.kidnapped.clear();
  diagnostics.warn(robot.location,
                   fmt::format("robot '{}' navigates by laser; it is assumed to {}", robot.name,
                               robot.waypoints.empty() ? "stand at its start"
                               : is_unknown ? "follow its waypoints, without being kidnapped"
                                            : "drive straight over its waypoints or goals"));
}

}  // namespace

Scenario as_planned(const Scenario& scenario, Diagnostics& diagnostics) {
  Scenario planned = scenario;
  if (scenario.pose.source != PoseSource::kSlam) return planned;
  planned.pose.source = PoseSource::kTrue;
  bool any_drives = false;
  for (RobotSpec& robot : planned.robots) {
    if (drives(robot)) plan(robot, diagnostics);
    any_drives = any_drives || drives(robot);
  }
  // There may be no robot left whose arrival would end the run.
  if (!any_drives && !planned.duration_s) planned.duration_s = planned.time_step_s;
  return planned;
}

Simulation simulation_at(const Scenario& scenario, std::uint64_t seed, Time time) {
  Simulation simulation(scenario, seed);
  while (simulation.now() < time) {
    if (simulation.finished()) {
      throw Error(fmt::format("the run ends at {:g} s, but {:g} s was asked for",
                              to_seconds(simulation.now()), to_seconds(time)));
    }
    simulation.skip_step();
  }
  return simulation;
}

std::string absence_of(const TagSpec& tag, Time time) {
  if (time < tag.appears) {
    return fmt::format("not there yet (appears at {:g} s)", to_seconds(tag.appears));
  }
  if (tag.disappears && time >= *tag.disappears) {
    return fmt::format("gone (disappeared at {:g} s)", to_seconds(*tag.disappears));
  }
  return "";
}

std::vector<MovingBody> standing_bodies(const Scenario& scenario, Diagnostics& diagnostics) {
  Scenario alone;
  alone.duration_s = 1.0;
  std::size_t others = 0;
  for (const ObstacleSpec& obstacle : scenario.obstacles) {
    if (!obstacle.body) continue;
    const bool stands =
        obstacle.motion.size() == 1 && obstacle.appears <= Time{} && !obstacle.disappears;
    if (stands) alone.obstacles.push_back(obstacle);
    if (!stands) ++others;
  }
  for (const RobotSpec& robot : scenario.robots) {
    if (robot.body) ++others;
  }
  if (others > 0) {
    diagnostics.warn(
        fmt::format("{} moving {} left out: obstacles that move or come and go, and "
                    "robots, block no waves here",
                    others, others == 1 ? "body is" : "bodies are"));
  }
  return Simulation(alone, scenario.seed).bodies_at(Time{});
}

void leave_out_absent_tags(Time time, Scenario& scenario, Diagnostics& diagnostics) {
  constexpr std::size_t kNamed = 5;
  std::size_t absent = 0;
  std::erase_if(scenario.tags, [&](const TagSpec& tag) {
    const std::string why = absence_of(tag, time);
    if (why.empty()) return false;
    if (++absent <= kNamed) {
      diagnostics.warn(tag.location, fmt::format("tag '{}' is left out: at {:g} s it is {}", tag.id,
                                                 to_seconds(time), why));
    }
    return true;
  });
  if (absent > kNamed) {
    diagnostics.warn(fmt::format("{} more tags are left out, as they are not there at {:g} s",
                                 absent - kNamed, to_seconds(time)));
  }
}

}  // namespace tagfield
