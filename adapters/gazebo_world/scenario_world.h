// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of a scenario to a Gazebo 11 world with Tagfield's plugins.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/scenario/scenario.h"
#include "tagfield/world/scene.h"

namespace tagfield {

/// How to write the world, as opposed to its contents.
struct GazeboWorldOptions {
  /// The robots' model.sdf. Its model stands on the floor with its origin centred between its
  /// wheels, and has a link `base_link` and the plugin libTagfieldRobotPlugin.so.
  std::string robot_model;
  /// Multiple of real time to run at, 0 for as fast as possible; if not set, as stated by the
  /// scenario, or else by its world.
  std::optional<double> real_time;
};

/// Up to this many tags at rest get a model each, so that they can be seen and moved individually;
/// more are combined into one model with a table, as many models slow Gazebo down.
inline constexpr std::size_t kMaxTagModels = 100;

/// The text of a `.world` file: the scenario's own world, or a floor and a sun if it has none, with
/// the scenario's robots, antennas and tags, and with the world's materials if antennas have
/// physical models. Profiles become plain settings. `scenario` holds what the YAML file states and
/// not what its world contains already; `scene` is that world.
///
/// Relative paths in the world become absolute; `model://` URIs and paths inside models stay, and
/// are found if Gazebo searches gazebo_model_paths(). Left out with a warning: antennas that follow
/// a recording, tags with a trajectory, and the times at which tags appear and disappear. Throws
/// Error if the world or the robot's model can't be read or is unsuitable, or if a name or an ID
/// has characters that XML can't represent.
std::string gazebo_world(const Scenario& scenario, const Scene& scene,
                         const GazeboWorldOptions& options, Diagnostics& diagnostics);

/// The folders to list in GAZEBO_MODEL_PATH for the scenario's world.
std::vector<std::string> gazebo_model_paths(const Scenario& scenario);

}  // namespace tagfield
