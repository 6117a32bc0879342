// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run's folder as JSON for the page, which shows it with a time slider.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tagfield/map/occupancy_grid.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/report/page.h"
#include "tagfield/report/run_files.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield::http {

/// The world, its antennas with their beams and its robots' paths, as stored in a run's folder
/// (scene.json); everything else that is shown comes from its tables.
std::string scene_json(const ScenarioWithWorld& loaded);

/// Surroundings of a run, apart from its tables.
struct Surroundings {
  std::string scene;                     ///< As returned by scene_json(); "" if unknown.
  std::optional<OccupancyGrid> map;      ///< Used by robots for navigation.
  std::vector<AntennaPose> robot_poses;  ///< True ones; `antenna` holds the robot's name.
};

/// Reads scene.json, map.yaml and truth/robot_poses.csv of a run's folder, if present. Throws Error
/// if one of them is malformed.
Surroundings read_surroundings(const std::string& folder);

/// Thinned to every second, third, … of them if there are more than 200,000 reads, or more than
/// 100,000 poses of an antenna or robot. Throws Error if the scene is malformed.
std::string run_json(const RunFiles& run, const Surroundings& around);

/// A function that makes the view which report.html embeds of a run in `folder`; none if the
/// program was built without the page. Throws Error as read_surroundings() does.
MakeView view_of(const std::string& folder);

}  // namespace tagfield::http
