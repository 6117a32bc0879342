// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/navigation_summary.h"

#include <gtest/gtest.h>

#include "tagfield/experiment/store/seed_run_json.h"
#include "tagfield/simulator/test/small_world.h"

namespace tagfield {
namespace {

const NavigationWorld& world() {
  static const NavigationWorld made = [] {
    Diagnostics diagnostics;
    return navigation_world(small_drive(), small_room(), diagnostics);
  }();
  return made;
}

SeedRun run_of(std::uint64_t seed) {
  SeedRun run;
  run.seed = seed;
  run.navigation.emplace();
  run.navigation->map = world().true_map;
  run.navigation->closest_m = 0.3;
  return run;
}

GoalOutcome goal_of(DriveState state, const std::string& reason, const PlanarPose& truth) {
  return {{1.0, 0.0, 0.0}, state, reason, truth, 5.0};
}

TEST(NavigationSummary, CountsWhatIsTrulyReached) {
  std::vector<SeedRun> runs{run_of(4), run_of(5)};
  runs[0].navigation->goals = {goal_of(DriveState::kReached, "", {1.1, 0.0, 0.0}),
                               goal_of(DriveState::kReached, "", {1.0, 2.0, 0.0})};
  runs[1].navigation->goals = {goal_of(DriveState::kRefused, "off the map", {})};
  const NavigationSummary summary = navigation_summary(runs, world());
  EXPECT_EQ(summary.goals, 3U);
  EXPECT_EQ(summary.goals_reached, 1U);
  ASSERT_EQ(summary.goals_unreached.size(), 2U);
  EXPECT_EQ(summary.goals_unreached[0].seed, 4U);
  EXPECT_EQ(summary.goals_unreached[0].reason, "it believed it was there, but was 2.00 m away");
  EXPECT_EQ(summary.goals_unreached[1].seed, 5U);
  EXPECT_EQ(summary.goals_unreached[1].reason, "off the map");
}

TEST(NavigationSummary, SumsFindingsUpBySort) {
  std::vector<SeedRun> runs{run_of(1), run_of(2)};
  runs[0].navigation->findings = {{PositionLoss::kStart, true, 10.0, 2.0, 0},
                                  {PositionLoss::kKidnapped, true, 20.0, 4.0, 1}};
  runs[1].navigation->findings = {{PositionLoss::kStart, true, 30.0, 6.0, 0},
                                  {PositionLoss::kKidnapped, false, std::nullopt, 0.0, 0}};
  runs[1].navigation->collisions = 2;
  runs[1].navigation->closest_m = 0.0;
  const NavigationSummary summary = navigation_summary(runs, world());
  ASSERT_TRUE(summary.unknown_starts.has_value());
  EXPECT_EQ(summary.unknown_starts->found, 2U);
  EXPECT_EQ(summary.unknown_starts->seconds->mean, 20.0);
  EXPECT_EQ(summary.unknown_starts->driven_m->max, 6.0);
  ASSERT_TRUE(summary.kidnapped.has_value());
  EXPECT_EQ(summary.kidnapped->count, 2U);
  EXPECT_EQ(summary.kidnapped->noticed, 1U);
  EXPECT_EQ(summary.kidnapped->found, 1U);
  EXPECT_EQ(summary.kidnapped->wrong, 1U);
  EXPECT_FALSE(summary.lost.has_value());
  EXPECT_EQ(summary.collisions, 2U);
  EXPECT_EQ(summary.closest_m, 0.0);
  EXPECT_EQ(summary.walls_found, 1.0);
}

TEST(NavigationSummary, WarnsOfRobotsThatDriveThroughEachOther) {
  std::vector<SeedRun> runs{run_of(1), run_of(2)};
  Diagnostics diagnostics;
  warn_of_robot_contacts(runs, diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  runs[1].navigation->robot_contacts = {{"a", "b", 56.04, {1.0, -2.0}}};
  warn_of_robot_contacts(runs, diagnostics);
  runs[0].navigation->robot_contacts = {{"a", "c", 3.0, {0.0, 0.0}}};
  warn_of_robot_contacts(runs, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 2U);
  EXPECT_EQ(diagnostics.warnings()[0],
            "robots 'a' and 'b' drive through each other at 56.0 s, around (1.00, -2.00): robots "
            "neither see nor avoid one another");
  EXPECT_EQ(diagnostics.warnings()[1],
            "robots 'a' and 'c' drive through each other at 3.0 s, around (0.00, 0.00), and there "
            "are 2 such collisions in all: robots neither see nor avoid one another");
}

/// Random starts and goals: each seed has its own, and the number of threads makes no difference.
TEST(RunSeeds, OfRobotsThatDriveByThemselves) {
  Scenario scenario = small_drive();
  own_navigation(scenario).start = StartBelief::kRandom;
  scenario.robots[0].waypoints.clear();
  scenario.robots[0].random_goals = 1;
  NavigationWorld known = world();
  known.given_map = known.true_map;
  Diagnostics diagnostics;
  RunControl one;
  RunControl two;
  two.threads = 2;
  const auto alone = run_seeds(scenario, 1, 2, one, diagnostics, &known);
  const auto together = run_seeds(scenario, 1, 2, two, diagnostics, &known);
  ASSERT_EQ(alone.size(), 2U);
  for (std::size_t i = 0; i < 2; ++i) {
    const NavigationRun& run = *alone[i].navigation;
    ASSERT_EQ(run.goals.size(), 1U);
    EXPECT_EQ(run.goals[0].state, DriveState::kReached) << run.goals[0].reason;
    ASSERT_EQ(run.findings.size(), 1U);
    EXPECT_EQ(run.findings[0].why, PositionLoss::kStart);
    EXPECT_EQ(run.collisions, 0);
    EXPECT_EQ(run.position_errors_m, together[i].navigation->position_errors_m);
  }
  // What a log keeps of seeds other than the first is all that the summary needs.
  std::vector<SeedRun> kept = {alone[0], kept_seed_in(to_json_line(alone[1], {}), {}).run};
  EXPECT_EQ(to_json(summarize(scenario, kept, 1.0, {}, &known)),
            to_json(summarize(scenario, alone, 1.0, {}, &known)));
  EXPECT_NE(alone[0].navigation->goals[0].goal_M.x, alone[1].navigation->goals[0].goal_M.x);
}

}  // namespace
}  // namespace tagfield
