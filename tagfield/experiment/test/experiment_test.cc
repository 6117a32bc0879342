// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/experiment.h"

#include <gtest/gtest.h>

#include <atomic>

#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/files/reads_csv.h"
#include "tagfield/scenario/navigation_spec.h"

namespace tagfield {
namespace {

/// A robot drives an L of 8 m; one tag can be located, one is out of range, one rides along.
Scenario small_experiment() {
  Scenario scenario;
  scenario.name = "small";
  RobotSpec robot;
  robot.name = "robot";
  robot.waypoints = {{4.0, 0.0}, {4.0, 4.0}};
  scenario.robots = {robot};
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  antenna.on = "robot";
  antenna.X_PA = from_translation({0.0, 0.0, 1.0});
  scenario.antennas = {antenna};
  const auto add_tag = [&](const std::string& id, const Eigen::Vector3d& p, const std::string& on) {
    TagSpec tag;
    tag.id = id;
    tag.on = on;
    tag.motion = {{Time{}, from_translation(p)}};
    scenario.tags.push_back(tag);
  };
  add_tag("near", {2.0, 3.0, 1.4}, "");
  add_tag("far", {50.0, 0.0, 1.0}, "");
  add_tag("load", {0.0, 0.3, 0.5}, "robot");
  return scenario;
}

TEST(RunSeeds, JudgesEachTagByWhatItIs) {
  Diagnostics diagnostics;
  const auto runs = run_seeds(small_experiment(), 1, 1, {}, diagnostics);
  ASSERT_EQ(runs.size(), 1U);
  const auto& outcomes = runs[0].outcomes;
  ASSERT_EQ(outcomes.size(), 3U);
  ASSERT_TRUE(error_of(outcomes[0]).has_value());
  EXPECT_LT(*error_of(outcomes[0]), 0.05);
  EXPECT_EQ(outcomes[1].estimate.reason, "cannot localize: never read");
  EXPECT_EQ(outcomes[1].estimate.verdict, Verdict::kNotLocated);
  EXPECT_TRUE(outcomes[2].moved);
  EXPECT_EQ(outcomes[2].estimate.verdict, Verdict::kNotLocated);
  EXPECT_NEAR(runs[0].path_length_m, 8.0, 0.8);
}

TEST(RunSeeds, ThreadsChangeNothing) {
  Diagnostics diagnostics;
  RunControl one;
  RunControl two;
  two.threads = 2;
  const auto alone = run_seeds(small_experiment(), 3, 4, one, diagnostics);
  const auto together = run_seeds(small_experiment(), 3, 4, two, diagnostics);
  ASSERT_EQ(alone.size(), together.size());
  EXPECT_EQ(reads_to_csv(alone[0].recording.reads), reads_to_csv(together[0].recording.reads));
  for (std::size_t i = 0; i < alone.size(); ++i) {
    EXPECT_EQ(alone[i].seed, together[i].seed);
    EXPECT_EQ(error_of(alone[i].outcomes[0]), error_of(together[i].outcomes[0]));
  }
}

// The progress callback needs no lock, and progress never decreases.
TEST(RunSeeds, CountsTheFinishedSeedsOneByOne) {
  Diagnostics diagnostics;
  std::vector<double> shares;
  RunControl control;
  control.threads = 3;
  control.on_progress = [&](double share) { shares.push_back(share); };
  run_seeds(small_experiment(), 1, 4, control, diagnostics);
  EXPECT_EQ(shares, (std::vector<double>{0.25, 0.5, 0.75, 1.0}));
}

TEST(RunSeeds, ComparesANoisyPoseWithTheTrueOne) {
  Scenario scenario = small_experiment();
  scenario.pose.source = PoseSource::kNoisy;
  scenario.pose.sigma_m = 0.02;
  Diagnostics diagnostics;
  const auto runs = run_seeds(scenario, 1, 4, {}, diagnostics);
  const Summary summary = summarize(scenario, runs, 1.0, diagnostics);
  ASSERT_TRUE(summary.pose_error.has_value());
  // Two axes of 2 cm give 2.8 cm; one drive of 25 s has about five independent errors.
  EXPECT_GT(summary.pose_error->position_rms_m, 0.01);
  EXPECT_LT(summary.pose_error->position_rms_m, 0.06);
  ASSERT_TRUE(summary.pose_error->error_with_true_pose_m.has_value());
  EXPECT_LT(summary.pose_error->error_with_true_pose_m->mean, 0.02);
}

TEST(RunSeeds, ComparesMethodsOverAllSeeds) {
  Scenario scenario = small_experiment();
  scenario.localization.method = "auto";
  scenario.localization.compare = {"ml", "hyperbola", "ml"};
  Diagnostics diagnostics;
  const auto runs = run_seeds(scenario, 1, 2, {}, diagnostics);
  const Summary summary = summarize(scenario, runs, 1.0, diagnostics);
  EXPECT_EQ(summary.method, "ml");  // With an exact pose and a clean phase.
  EXPECT_EQ(summary.method_asked, "auto");
  EXPECT_FALSE(summary.method_why.empty());
  ASSERT_EQ(summary.compared_methods.size(), 2U);
  EXPECT_EQ(summary.compared_methods[0].method, "ml");
  EXPECT_EQ(summary.compared_methods[0].located, count(summary, Verdict::kLocated));
  EXPECT_EQ(summary.compared_methods[0].error_m->mean, error_statistics(summary)->mean);
  EXPECT_FALSE(summary.compared_methods[0].aligned_error_m);
  scenario.localization.method = "hyperbola";
  const auto alone = run_seeds(scenario, 1, 2, {}, diagnostics);
  EXPECT_EQ(summary.compared_methods[1].method, "hyperbola");
  EXPECT_EQ(summary.compared_methods[1].error_m->mean,
            error_statistics(summarize(scenario, alone, 1.0, diagnostics))->mean);
}

TEST(RunSeeds, ReferenceTagsHaveNoError) {
  Scenario scenario = small_experiment();
  scenario.localization.reference_tags = {"near"};
  Diagnostics diagnostics;
  const auto runs = run_seeds(scenario, 1, 1, {}, diagnostics);
  for (const TagOutcome& outcome : runs[0].outcomes) {
    EXPECT_EQ(outcome.reference, outcome.estimate.tag == "near");
    if (outcome.reference) {
      EXPECT_FALSE(error_of(outcome));
    }
  }
}

TEST(RunSeeds, CorrectedPosesAreCloserToTheTruth) {
  Scenario scenario = small_experiment();
  scenario.pose.source = PoseSource::kNoisy;
  scenario.pose.sigma_m = 0.02;
  scenario.localization.method = "joint";
  Diagnostics diagnostics;
  const auto runs = run_seeds(scenario, 1, 2, {}, diagnostics);
  EXPECT_FALSE(runs[0].corrected_poses.empty());
  EXPECT_TRUE(runs[1].corrected_poses.empty());  // Not kept, like recordings.
  EXPECT_TRUE(summarize(scenario, runs, 1.0, diagnostics).pose_error->corrected_rms_m);
}

TEST(RunSeeds, StopsEarlyAndSaysSo) {
  const std::atomic<bool> stop{true};
  RunControl control;
  control.stop = &stop;
  Diagnostics diagnostics;
  const auto runs = run_seeds(small_experiment(), 1, 5, control, diagnostics);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_FALSE(runs[0].complete);
  EXPECT_FALSE(summarize(small_experiment(), runs, 1.0, diagnostics).complete);
}

/// Between one tag and the next.
TEST(RunSeeds, StopsWhileLocating) {
  Diagnostics diagnostics;
  std::atomic<bool> stop{false};
  RunControl control;
  control.stop = &stop;
  std::size_t reports = 0;
  control.on_stage = [&](const std::string&, double) { ++reports; };
  const SeedRun whole = run_seeds(small_experiment(), 1, 1, {}, diagnostics).at(0);
  SeedRun run = simulate(small_experiment(), 1, {});
  localize(small_experiment(), run, control, diagnostics);
  EXPECT_TRUE(run.complete);
  EXPECT_EQ(reports, 2U);  // Of the tags that were read.
  control.on_stage = [&](const std::string&, double) { stop = true; };
  run = simulate(small_experiment(), 1, {});
  localize(small_experiment(), run, control, diagnostics);
  EXPECT_FALSE(run.complete);
  EXPECT_EQ(run.method, "none");
  EXPECT_EQ(run.recording.reads.size(), whole.recording.reads.size());
  ASSERT_EQ(run.outcomes.size(), 3U);
  for (const TagOutcome& outcome : run.outcomes) EXPECT_EQ(outcome.estimate.reason, "interrupted");
}

TEST(RunSeeds, KeepsItsEstimatesWhenStoppedWhileOthersAreCompared) {
  Diagnostics diagnostics;
  std::atomic<bool> stop{false};
  std::size_t reports = 0;
  RunControl control;
  control.stop = &stop;
  control.on_stage = [&](const std::string&, double) { stop = ++reports > 2; };
  Scenario scenario = small_experiment();
  scenario.localization.compare = {"ml"};
  SeedRun run = simulate(scenario, 1, {});
  localize(scenario, run, control, diagnostics);
  EXPECT_FALSE(run.complete);
  EXPECT_EQ(run.method, "hyperbola");
  ASSERT_EQ(run.outcomes.size(), 3U);
  EXPECT_LT(*error_of(run.outcomes[0]), 0.05);
  EXPECT_TRUE(run.compared.empty());
}

// A wall that is anywhere in its cell is uniformly distributed over it.
TEST(MapError, OfAGivenMapIsThatOfItsCellsUnlessStated) {
  Scenario scenario;
  RobotSpec robot;
  robot.start = {1.0, 2.0, 0.5};
  robot.waypoints = {{3.0, 2.0}};
  scenario.robots = {robot};
  SeedRun run;
  EXPECT_FALSE(map_error_of(scenario, run));
  run.navigation.emplace();
  run.navigation->map.resolution_m = 0.12;
  const auto of_cells = map_error_of(scenario, run);
  EXPECT_EQ(*of_cells->origin_W, Eigen::Vector2d(1.0, 2.0));
  EXPECT_TRUE(of_cells->covariance.diagonal().isApprox(Eigen::Vector3d(1.2e-3, 1.2e-3, 0.0), 1e-9));
  own_navigation(scenario).map_sigma_m = 0.05;
  EXPECT_NEAR(map_error_of(scenario, run)->covariance(1, 1), 2.5e-3, 1e-12);
}

TEST(KnownHeights, AreTheRestingTags) {
  Scenario scenario = small_experiment();
  EXPECT_EQ(known_beforehand(scenario).heights.of_tag.size(), 2U);
  EXPECT_EQ(known_beforehand(scenario).heights.of_tag.at("near"), 1.4);
  scenario.localization.known_height = KnownHeight::kAntenna;
  EXPECT_TRUE(known_beforehand(scenario).heights.of_tag.empty());
  EXPECT_FALSE(known_beforehand(scenario).heights.of_all.has_value());
}

}  // namespace
}  // namespace tagfield
