// SPDX-License-Identifier: Apache-2.0
/// @file
/// The parts of a scenario that configure robot navigation.
#pragma once

#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// `navigation`: truth, noisy, odometry or slam; or a mapping with that as `mode` and the keys
/// listed in docs/scenario.md.
PoseSource read_navigation(const YamlValue& value, NavigationSpec& navigation);

/// A robot's `goals`, `random_goals` and `kidnapped`. Throws Error if it has more than one of
/// goals, random goals and waypoints.
void read_self_driving(YamlMap& map, RobotSpec& robot);

/// Throws Error if a robot has keys that are only for robots that navigate by themselves.
void forbid_self_driving(YamlMap map);

/// One of `obstacles`.
ObstacleSpec obstacle_of(YamlMap map, const RadioWorldOptions& world);

}  // namespace tagfield
