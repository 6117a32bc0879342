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

}  // namespace tagfield
