// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/navigation_summary.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/map/true_map.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Keeps the worst values of maps and distances over all seeds.
void add_map(const NavigationRun& run, const NavigationWorld& world, bool first,
             NavigationSummary& summary) {
  const MapComparison map = compare_maps(run.map, world.true_map);
  const auto least = [&](double& kept, double value) {
    kept = first ? value : std::min(kept, value);
  };
  const auto most = [&](double& kept, double value) {
    kept = first ? value : std::max(kept, value);
  };
  least(summary.walls_found, map.found_share);
  most(summary.walls_false, map.false_share);
  most(summary.walls_double, map.double_wall_share);
  least(summary.floor_known, map.known_share);
  least(summary.closest_m, run.closest_m);
  if (!first || !run.survey) return;
  summary.mapping_path_m = run.survey->path_length_m;
  summary.mapping_s = run.survey->simulated_s;
}

/// Why a goal was not reached; "" if it was.
std::string fault_of(const GoalOutcome& goal) {
  if (goal.state != DriveState::kReached) return goal.reason;
  const double off_m = (position_of(goal.truth_W) - position_of(goal.goal_M)).norm();
  if (off_m <= kTrulyThere_m) return "";
  return fmt::format("it believed it was there, but was {:.2f} m away", off_m);
}

void add_goals(const SeedRun& run, NavigationSummary& summary) {
  summary.goals += run.navigation->goals.size();
  for (const GoalOutcome& goal : run.navigation->goals) {
    const std::string fault = fault_of(goal);
    if (fault.empty()) {
      ++summary.goals_reached;
    } else {
      const PlanarPose& place = goal.goal_M;
      summary.goals_unreached.push_back({run.seed, {place.x, place.y, place.yaw}, fault});
    }
  }
}

std::optional<FindingSummary> findings_of(const std::vector<SeedRun>& runs, PositionLoss why) {
  FindingSummary summary;
  std::vector<double> seconds;
  std::vector<double> ways_m;
  for (const SeedRun& run : runs) {
    for (const Finding& finding : run.navigation->findings) {
      if (finding.why != why) continue;
      ++summary.count;
      if (finding.noticed) ++summary.noticed;
      summary.wrong += static_cast<std::size_t>(finding.wrong);
      if (!finding.seconds) continue;
      ++summary.found;
      seconds.push_back(*finding.seconds);
      ways_m.push_back(finding.driven_m);
    }
  }
  if (summary.count == 0) return std::nullopt;
  summary.seconds = statistics(seconds);
  summary.driven_m = statistics(ways_m);
  return summary;
}

}  // namespace

void warn_of_robot_contacts(const std::vector<SeedRun>& runs, Diagnostics& diagnostics) {
  const RobotContact* first = nullptr;
  std::size_t count = 0;
  for (const SeedRun& run : runs) {
    if (!run.navigation || run.navigation->robot_contacts.empty()) continue;
    count += run.navigation->robot_contacts.size();
    if (first == nullptr) first = &run.navigation->robot_contacts.front();
  }
  if (first == nullptr) return;
  diagnostics.warn(fmt::format(
      "robots '{}' and '{}' drive through each other at {:.1f} s, around ({:.2f}, {:.2f}){}: "
      "robots "
      "neither see nor avoid one another",
      first->one, first->other, first->at_s, first->place.x(), first->place.y(),
      count > 1 ? fmt::format(", and there are {} such collisions in all", count) : ""));
}

NavigationSummary navigation_summary(const std::vector<SeedRun>& runs,
                                     const NavigationWorld& world) {
  NavigationSummary summary;
  std::vector<double> positions;
  std::vector<double> yaws;
  for (const SeedRun& run : runs) {
    const NavigationRun& navigation = *run.navigation;
    add_map(navigation, world, &run == &runs.front(), summary);
    add_goals(run, summary);
    summary.collisions += static_cast<std::size_t>(navigation.collisions);
    summary.times_lost += static_cast<std::size_t>(navigation.times_lost);
    positions.insert(positions.end(), navigation.position_errors_m.begin(),
                     navigation.position_errors_m.end());
    yaws.insert(yaws.end(), navigation.yaw_errors_rad.begin(), navigation.yaw_errors_rad.end());
  }
  summary.position_error_m = statistics(positions);
  summary.yaw_error_rad = statistics(yaws);
  summary.unknown_starts = findings_of(runs, PositionLoss::kStart);
  summary.kidnapped = findings_of(runs, PositionLoss::kKidnapped);
  summary.lost = findings_of(runs, PositionLoss::kLost);
  return summary;
}

}  // namespace tagfield
