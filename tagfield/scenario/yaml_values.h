// SPDX-License-Identifier: Apache-2.0
/// @file
/// Values used in several parts of a scenario: choices, paths, positions, motions.
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/localization/problem.h"
#include "tagfield/poses/rigid_transform.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Index of the word among `choices`; throws Error that suggests the most similar one.
std::size_t choice(const YamlValue& value, const std::vector<std::string>& choices);

/// A path as the user means it: one in the file is relative to the file, one from --set to the
/// current folder.
std::string resolve_path(const YamlValue& value);

/// Seconds that the simulation's clock can hold.
double seconds_of(const YamlValue& value, NumberRange range);

/// The time in which something is there: the keys `appears_s` and `disappears_s`, the second of
/// which must be later.
struct Lifetime {
  Time appears{};
  std::optional<Time> disappears{};  ///< Never if unset.
};
Lifetime lifetime_of(YamlMap& map);

Eigen::Vector3d position_of(const YamlValue& value);

/// The area where tags can be, from the keys `side` and `box` ([x0, y0, x1, y1] with corners in any
/// order).
TagArea tag_area_of(YamlMap& map);

/// [x, y, z] or [x, y, z, roll, pitch, yaw], as in SDF.
RigidTransform pose_of(const YamlValue& value);

/// Rows [t, x, y, z], or [t, x, y] where `columns` is 3; at least one.
Trajectory trajectory_of(const YamlValue& value, std::size_t columns = 4);

}  // namespace tagfield
