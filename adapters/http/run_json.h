/// @file
/// A run's folder as JSON for the page, which shows it with a slider over its time.
#pragma once

#include <string>

#include "tagfield/planning/link_explanation.h"
#include "tagfield/report/run_files.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield::http {

/// The world, its antennas with their beams and its robots' ways, as a run's folder keeps them
/// (scene.json): what else there is to see, its tables tell.
std::string scene_json(const ScenarioWithWorld& loaded);

/// `scene`: a scene.json's text, or "" for none. Of more than 200,000 reads every second, third, …
/// is in it. Throws Error, which names `folder`, where the scene is no JSON object.
std::string run_json(const RunFiles& run, const std::string& scene, const std::string& folder);

/// The page with the run inside: one file that needs nothing else. "" where the program was built
/// without the page.
std::string view_page(const std::string& run);

}  // namespace tagfield::http
