/// @file
/// The parts of a scenario that say how robots find their way.
#pragma once

#include "simulator/internal/yaml_map.h"
#include "simulator/navigation_spec.h"
#include "simulator/obstacle.h"
#include "simulator/pose_error.h"

namespace tagfield {

/// `navigation`: truth, noisy, odometry or slam; or a mapping with that as `mode` and with what
/// docs/scenario.md lists.
PoseSource read_navigation(const YamlValue& value, NavigationSpec& navigation);

/// One of `obstacles`.
ObstacleSpec obstacle_of(YamlMap map);

}  // namespace tagfield
