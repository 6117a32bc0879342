// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/internal/robots.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <set>
#include <string>

#include "tagfield/base/random.h"
#include "tagfield/base/spelling.h"

namespace tagfield {
namespace {

void require_remote(const Scenario& scenario, const RemoteDriving& remote) {
  std::vector<std::string> names;
  for (const RobotSpec& robot : scenario.robots) names.push_back(robot.name);
  if (std::find(names.begin(), names.end(), remote.robot) != names.end()) return;
  throw Error(fmt::format("there is no robot '{}' to be driven{}", remote.robot,
                          suggestion(remote.robot, names)));
}

}  // namespace

std::vector<Robot> robots_of(const Scenario& scenario, std::uint64_t seed,
                             const SelfDriving* driving, const RemoteDriving* remote) {
  if (remote != nullptr) require_remote(scenario, *remote);
  std::vector<Robot> robots;
  std::set<std::string> names;
  bool has_mapped = true;
  for (const RobotSpec& robot : scenario.robots) {
    if (!names.insert(robot.name).second) {
      fail(robot.location, fmt::format("a second robot is called '{}'", robot.name));
    }
    if (remote != nullptr && remote->robot == robot.name) {
      auto driver = std::make_unique<RemoteDriver>(*remote, navigation_of(scenario), seed,
                                                   stream_key(robot.name));
      robots.emplace_back(robot, std::move(driver), seed);
    } else if (driving != nullptr && drives(robot)) {
      robots.push_back(self_driving_robot(scenario, robot, *driving, has_mapped, seed));
      has_mapped = false;
    } else {
      robots.emplace_back(robot, scenario.pose, seed);
    }
  }
  return robots;
}

const Robot* robot_named(const std::vector<Robot>& robots, const std::string& name) {
  const auto found = std::find_if(robots.begin(), robots.end(),
                                  [&](const Robot& robot) { return robot.name() == name; });
  return found == robots.end() ? nullptr : &*found;
}

void require_robot(const std::vector<Robot>& robots, const std::string& name,
                   const Location& location) {
  if (!name.empty() && robot_named(robots, name) == nullptr) {
    fail(location, fmt::format("there is no robot '{}' to be on", name));
  }
}

double progress_of(const std::vector<Robot>& robots) {
  double slowest = 1.0;
  for (const Robot& robot : robots) slowest = std::min(slowest, robot.progress());
  return slowest;
}

double travelled_by(const std::vector<Robot>& robots) {
  double travelled = 0.0;
  for (const Robot& robot : robots) travelled += robot.travelled_m();
  return travelled;
}

}  // namespace tagfield
