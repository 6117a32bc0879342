// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_at.h"

#include "tagfield/planning/moment.h"

namespace tagfield {

LinkExplanation explain_link_at(const Scenario& scenario, const AntennaSpec& antenna,
                                const TagSpec& tag, Time time, std::uint64_t seed) {
  const Simulation simulation = simulation_at(scenario, seed, time);
  LinkQuestion question{antenna,
                        tag,
                        time,
                        simulation.antenna_pose(antenna, time),
                        simulation.tag_pose(tag, time),
                        seed,
                        simulation.bodies_at(time)};
  for (const TagSpec& other : scenario.tags) {
    if (&other == &tag || !absence_of(other, time).empty()) continue;
    question.other_tags.push_back({other, simulation.tag_pose(other, time)});
  }
  for (const AntennaSpec& other : scenario.antennas) {
    if (&other == &antenna) continue;
    question.other_antennas.push_back({other, simulation.antenna_pose(other, time)});
  }
  return explain_link(scenario, question);
}

}  // namespace tagfield
