// SPDX-License-Identifier: Apache-2.0
/// @file
/// The parts of a scenario that say how robots find their way.
#pragma once

#include "tagfield/scenario/navigation_spec.h"
#include "tagfield/scenario/robot_spec.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// `navigation`: truth, noisy, odometry or slam; or a mapping with that as `mode` and with what
/// docs/scenario.md lists.
PoseSource read_navigation(const YamlValue& value, NavigationSpec& navigation);

/// A robot's `goals`, `random_goals` and `carried`. Throws Error where it has more than one of
/// these goals and waypoints.
void read_self_driving(YamlMap& map, RobotSpec& robot);

/// Throws Error where a robot has what only one has that finds its way by itself.
void forbid_self_driving(YamlMap map);

/// One of `obstacles`.
ObstacleSpec obstacle_of(YamlMap map, const RadioWorldOptions& world);

}  // namespace tagfield
