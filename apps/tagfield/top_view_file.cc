// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/top_view_file.h"

#include <algorithm>
#include <utility>

#include "tagfield/map/top_view.h"

namespace tagfield {
namespace {

/// The height range of the view [m].
std::pair<double, double> band_of(const Scenario& scenario) {
  double highest = 1.0;
  for (const TagSpec& tag : scenario.tags) {
    for (const StampedPose& pose : tag.motion) {
      highest = std::max(highest, pose.X_WB.translation.z());
    }
  }
  for (const AntennaSpec& antenna : scenario.antennas) {
    highest = std::max(highest, antenna.X_PA.translation.z() + antenna.lift.travel_m);
    for (const StampedPose& pose : antenna.recorded) {
      highest = std::max(highest, pose.X_WB.translation.z());
    }
  }
  return {0.1, highest + 0.5};
}

}  // namespace

std::vector<Silhouette> outlines_of(const ScenarioWithWorld& loaded) {
  if (loaded.scene.collisions.empty()) return {};
  const auto [low, high] = band_of(loaded.scenario);
  return top_view(loaded.scene, low, high);
}

void stage_top_view(const ScenarioWithWorld& loaded, StagedFolder& folder) {
  if (loaded.scene.collisions.empty()) return;
  folder.add("top_view.json", top_view_to_json(outlines_of(loaded)));
}

}  // namespace tagfield
