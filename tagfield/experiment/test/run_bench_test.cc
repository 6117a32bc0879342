#include "tagfield/experiment/bench/run_bench.h"

#include <gtest/gtest.h>

#include <atomic>
#include <string>

#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/phase_curves/hyperbola.h"

namespace tagfield {
namespace {

/// Says that each tag is at one place, with the covariance of errors of 1 m.
Method constant_method() {
  return {"constant", "always the same place",
          [](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
            diagnostics.warn("guessed");
            LocalizationResult result;
            result.estimates = locate_each(
                problem, threads, [&](const std::string& tag, const SamplesOfTag& samples) {
                  TagEstimate estimate;
                  estimate.tag = tag;
                  estimate.verdict = Verdict::kLocated;
                  Candidate there;
                  there.p_WT = {static_cast<double>(samples.begin()->second.size()), 0.0, 1.5};
                  there.covariance = Eigen::Matrix3d::Identity();
                  estimate.candidates = {there};
                  return estimate;
                });
            return result;
          }};
}

std::vector<Method> with_constant() {
  std::vector<Method> methods = built_in_methods();
  methods.push_back(constant_method());
  return methods;
}

Suite small_suite() {
  Condition plain;
  plain.name = "plain";
  plain.scenario = TAGFIELD_SOURCE_DIR "/scenarios/z_axis.yaml";
  Condition lossy = plain;
  lossy.name = "lossy";
  lossy.lose = ReadLoss{0.5, 0.0, 0.0};
  lossy.methods = {"mine"};
  Suite suite;
  suite.name = "small";
  suite.first_seed = 5;
  suite.count = 3;
  suite.methods = {{"hyperbola", "hyperbola", {}, {}}, {"mine", "constant", {}, {}}};
  suite.conditions = {plain, lossy};
  return suite;
}

RunControl on_threads(int threads) {
  RunControl control;
  control.threads = threads;
  return control;
}

TEST(RunBench, RunsEachMethodInItsConditions) {
  const Bench bench = run_bench(small_suite(), with_constant(), on_threads(1));
  EXPECT_TRUE(bench.complete);
  ASSERT_EQ(bench.entries.size(), 3U);
  EXPECT_EQ(bench.entries[0].name, "hyperbola");
  EXPECT_EQ(bench.entries[1].condition, "plain");
  EXPECT_EQ(bench.entries[2].condition, "lossy");
  for (const BenchEntry& entry : bench.entries) {
    ASSERT_EQ(entry.runs.size(), 3U);
    EXPECT_EQ(entry.runs[0].seed, 5U);
    EXPECT_EQ(entry.runs[2].seed, 7U);
  }
  // Both methods of a condition get the same reads, and the lossy one about half of them.
  const auto reads_of = [&](std::size_t entry) {
    return static_cast<double>(bench.entries[entry].runs[0].tags[0].reads);
  };
  const double reads = reads_of(1);
  EXPECT_EQ(reads_of(0), reads);
  EXPECT_NEAR(reads_of(2), 0.5 * reads, 2.5 * std::sqrt(reads));
  EXPECT_TRUE(bench.entries[1].runs[0].tags[0].nees);
  ASSERT_EQ(bench.warnings.size(), 2U);
  EXPECT_EQ(bench.warnings[0], "condition 'plain', seed 5: guessed");
}

TEST(RunBench, DoesNotDependOnThreads) {
  const Bench one = run_bench(small_suite(), with_constant(), on_threads(1));
  const Bench four = run_bench(small_suite(), with_constant(), on_threads(4));
  EXPECT_EQ(bench_to_json(one, Timing::kWithoutTimes), bench_to_json(four, Timing::kWithoutTimes));
  EXPECT_EQ(bench_tags_to_csv(one), bench_tags_to_csv(four));
}

TEST(RunBench, StoppedKeepsWholeRuns) {
  std::atomic<bool> stop{false};
  RunControl control;
  control.stop = &stop;
  control.on_progress = [&](double share) { stop = share > 0.3; };
  const Bench bench = run_bench(small_suite(), with_constant(), control);
  EXPECT_FALSE(bench.complete);
  EXPECT_EQ(bench.entries[0].runs.size(), 2U);
  EXPECT_EQ(bench.entries[2].runs.size(), 0U);
}

TEST(RunBench, SaysWhyThereIsNoBound) {
  Suite suite = small_suite();
  suite.count = 1;
  suite.conditions[0].settings = {{"antennas.mobile.phase_noise_rad", "0"}};
  const Bench bench = run_bench(suite, with_constant(), on_threads(1));
  EXPECT_EQ(bench.conditions[0].no_bound, "antenna 'mobile' has no phase noise");
  EXPECT_FALSE(statistics_of(bench.entries[0]).ratio);
  EXPECT_EQ(bench.conditions[1].no_bound, "");
}

TEST(RunBench, ToldPoseErrorReachesTheMethods) {
  std::optional<PoseErrorModel> told;
  const std::vector<Method> methods = {
      hyperbola_method(),
      {"hear", "keeps what it is told", [&](const LocalizationProblem& problem, int, Diagnostics&) {
         told = problem.pose_error;
         return LocalizationResult{};
       }}};
  Suite suite = small_suite();
  suite.count = 1;
  suite.methods = {{"hear", "hear", {}, {}}};
  suite.conditions.resize(1);
  suite.conditions[0].settings = {{"pose.source", "noisy"}, {"pose.sigma_m", "0.02"}};
  run_bench(suite, methods, on_threads(1));
  ASSERT_TRUE(told);
  EXPECT_EQ(told->sigma_m, 0.02);
  suite.conditions[0].believed = PoseErrorModel{0.04, 0.0, 10.0};
  run_bench(suite, methods, on_threads(1));
  EXPECT_EQ(told.value().sigma_m, 0.04);
  suite.conditions[0].believed = UnknownPoseError{};
  run_bench(suite, methods, on_threads(1));
  EXPECT_FALSE(told);
  // A method's own settings go before the condition's.
  suite.conditions[0].believed = {};
  suite.methods[0].localization = {{"localization.pose_error", "{sigma_m: 0.07}"}};
  run_bench(suite, methods, on_threads(1));
  EXPECT_EQ(told.value().sigma_m, 0.07);
}

}  // namespace
}  // namespace tagfield
