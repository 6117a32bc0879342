// SPDX-License-Identifier: Apache-2.0
/// @file
/// A scenario as a world of Gazebo 11 with Tagfield's plugins in it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// How to write the world, as opposed to what is in it.
struct GazeboWorldOptions {
  /// The robots' model.sdf. Its model stands on the floor with its origin between its wheels, and
  /// has a link `base_link` and the plugin libTagfieldRobotPlugin.so.
  std::string robot_model;
  /// Multiple of real time to run at, 0 for as fast as it can; where not set, as the scenario says,
  /// and where that says nothing, as its world does.
  std::optional<double> real_time;
};

/// So many tags at rest are a model each, which can be seen and moved one by one; more are one
/// model with a table, as Gazebo gets slow with models.
inline constexpr std::size_t kMostTagModels = 100;

/// The text of a `.world` file: the scenario's own world, or a floor and a sun where it has none,
/// and in it the scenario's robots, antennas and tags, with what the world is made of where
/// antennas have physical models, whose profiles become plain settings. `scenario` holds what the
/// YAML file says and not what stands in its world already; `scene` is that world.
///
/// Relative paths in the world are made absolute; `model://` and what the models name stay, and are
/// found if Gazebo gets gazebo_model_paths(). Warned of and left out: antennas that follow a
/// recording, tags with a trajectory, tags' times of appearing and disappearing. Throws Error if
/// the world or the robot's model can't be read or is not as expected, or if a name or an ID has
/// characters that XML can't hold.
std::string gazebo_world(const Scenario& scenario, const Scene& scene,
                         const GazeboWorldOptions& options, Diagnostics& diagnostics);

/// The folders to name in GAZEBO_MODEL_PATH for the scenario's world.
std::vector<std::string> gazebo_model_paths(const Scenario& scenario);

}  // namespace tagfield
