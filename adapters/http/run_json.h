// SPDX-License-Identifier: Apache-2.0
/// @file
/// A run's folder as JSON for the page, which shows it with a slider over its time.
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

/// The world, its antennas with their beams and its robots' ways, as a run's folder keeps them
/// (scene.json): what else there is to see, its tables tell.
std::string scene_json(const ScenarioWithWorld& loaded);

/// What there was around a run, besides its tables.
struct Surroundings {
  std::string scene;                     ///< As scene_json() gives it; "" where it is not known.
  std::optional<OccupancyGrid> map;      ///< That robots found their way by.
  std::vector<AntennaPose> robot_poses;  ///< True ones; `antenna` holds the robot's name.
};

/// Of a run's folder: scene.json, map.yaml and truth/robot_poses.csv, where they are. Throws Error
/// where one of them is malformed.
Surroundings read_surroundings(const std::string& folder);

/// Of more than 200,000 reads every second, third, … is in it, and of more than 100,000 poses of an
/// antenna or robot. Throws Error where the scene is none.
std::string run_json(const RunFiles& run, const Surroundings& around);

/// Makes what report.html embeds of a run that is read from `folder`; none where the program was
/// built without the page. Throws Error as read_surroundings() does.
MakeView view_of(const std::string& folder);

}  // namespace tagfield::http
