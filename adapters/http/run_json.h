/// @file
/// A run's folder as JSON for the page, which shows it with a slider over its time.
#pragma once

#include <optional>
#include <string>

#include "tagfield/planning/link_explanation.h"
#include "tagfield/report/page.h"
#include "tagfield/report/run_files.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield::http {

/// The world, its antennas with their beams and its robots' ways, as a run's folder keeps them
/// (scene.json): what else there is to see, its tables tell.
std::string scene_json(const ScenarioWithWorld& loaded);

/// Of what is in `folder`, which `run` was read from: scene.json, where it is, and the robots' true
/// poses, besides `run`. Of more than 200,000 reads every second, third, …
/// is in it. Throws Error where one of the files is malformed.
std::string run_json(const RunFiles& run, const std::string& folder);

/// What report.html embeds of the run in `folder`; none where the program was built without the
/// page. Throws Error as run_json() does.
std::optional<RunView> run_view(const std::string& folder);

}  // namespace tagfield::http
