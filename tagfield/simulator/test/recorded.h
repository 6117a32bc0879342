// SPDX-License-Identifier: Apache-2.0
/// @file
/// Scenarios run from start to end, for tests of the results.
#pragma once

#include <string>

#include "tagfield/simulator/simulation.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

inline TagSpec tag_at(const std::string& id, const Eigen::Vector3d& position) {
  TagSpec tag;
  tag.id = id;
  tag.motion = {{Time{}, from_translation(position)}};
  return tag;
}

inline Recording recorded_run(const Scenario& scenario, std::uint64_t seed) {
  Recording recording;
  Simulation simulation(scenario, seed, recorded_in(recording));
  while (!simulation.finished()) simulation.step();
  return recording;
}

inline Recording recorded_run(const Scenario& scenario) {
  return recorded_run(scenario, scenario.seed);
}

}  // namespace tagfield
