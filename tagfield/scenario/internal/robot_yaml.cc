// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/robot_yaml.h"

#include <vector>

#include "tagfield/scenario/internal/navigation_yaml.h"
#include "tagfield/scenario/internal/radio_yaml.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace {

Eigen::Vector2d waypoint_of(const YamlValue& value) {
  const std::vector<double> n = value.lengths(2, 2);
  return {n[0], n[1]};
}

RobotBody robot_body_of(YamlMap map, const RadioWorldOptions& world) {
  RobotBody body;
  const YamlValue value = map.at("size", "[length, width, height] in m");
  const std::vector<double> size = value.lengths(3, 3);
  if (!(size[0] > 0.0 && size[1] > 0.0 && size[2] > 0.0)) {
    value.fail("must be three numbers greater than 0");
  }
  body.size_m = {size[0], size[1], size[2]};
  body.material = material_in(world, map.at("material", "the name of a material"));
  map.finish();
  return body;
}

}  // namespace

RobotSpec robot_of(YamlMap map, const RadioWorldOptions& world) {
  RobotSpec robot;
  robot.location = map.self().location();
  robot.name = map.at("name").text();
  const std::vector<double> start = map.at("start", "[x, y, yaw] in m and rad").lengths(3, 3);
  robot.start = {start[0], start[1], start[2]};
  robot.drive.wheel_radius_m = map.number("wheel_radius_m", robot.drive.wheel_radius_m, kPositive);
  robot.drive.track_m = map.number("track_m", robot.drive.track_m, kPositive);
  robot.style.speed_m_s = map.number("speed_m_s", robot.style.speed_m_s, kPositive);
  robot.style.max_turn_rad_s = map.number("max_turn_rad_s", robot.style.max_turn_rad_s, kPositive);
  robot.style.look_ahead_m = map.number("look_ahead_m", robot.style.look_ahead_m, kPositive);
  for (const YamlValue& waypoint : map.list("waypoints")) {
    robot.waypoints.push_back(waypoint_of(waypoint));
  }
  read_self_driving(map, robot);
  if (map.has("body")) robot.body = robot_body_of(YamlMap(map.at("body")), world);
  map.finish();
  return robot;
}

}  // namespace tagfield
