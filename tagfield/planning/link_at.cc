// SPDX-License-Identifier: Apache-2.0
#include "tagfield/planning/link_at.h"

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/planning/moment.h"

namespace tagfield {
namespace {

constexpr double kNothing = -std::numeric_limits<double>::infinity();

/// Margin at the weaker end of the budget [dB].
double margin_db(const LinkExplanation& link) {
  if (!link.physical || !link.physical->arrives) return kNothing;
  return std::min(link.physical->tag_margin_db(), link.physical->reader_margin_db());
}

/// How far inside the range the tag is [m].
double inside_m(const LinkExplanation& link) {
  return link.paper ? link.paper->range_m - link.distance_m : kNothing;
}

}  // namespace

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

bool is_better(const LinkExplanation& a, const LinkExplanation& b) {
  const auto worth = [](const LinkExplanation& link) {
    return std::tuple(link.read, margin_db(link), inside_m(link));
  };
  return worth(a) > worth(b);
}

LinkExplanation explain_best_link_at(const Scenario& scenario, const TagSpec& tag, Time time,
                                     std::uint64_t seed) {
  if (scenario.antennas.empty()) throw Error("the scenario has no antennas");
  LinkExplanation best = explain_link_at(scenario, scenario.antennas.front(), tag, time, seed);
  for (std::size_t i = 1; i < scenario.antennas.size(); ++i) {
    LinkExplanation other = explain_link_at(scenario, scenario.antennas[i], tag, time, seed);
    if (is_better(other, best)) best = std::move(other);
  }
  best.antennas_compared = scenario.antennas.size();
  return best;
}

}  // namespace tagfield
