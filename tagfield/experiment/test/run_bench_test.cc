// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <set>
#include <string>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/internal/statistics.h"
#include "tagfield/files/files.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/phase_curves/hyperbola.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

/// Locates every tag at the same position, with the covariance of errors of 1 m.
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
  int finished = 0;
  control.on_progress = [&](double) { stop = ++finished == 3; };
  const Bench bench = run_bench(small_suite(), with_constant(), control);
  EXPECT_FALSE(bench.complete);
  // One seed of all conditions is run before the next.
  EXPECT_EQ(bench.entries[0].runs.size(), 2U);
  EXPECT_EQ(bench.entries[1].runs.size(), 2U);
  EXPECT_EQ(bench.entries[2].runs.size(), 1U);
}

TEST(RunBench, ReportsProgressAfterEachRun) {
  std::vector<double> shares;
  RunControl control = on_threads(1);
  control.on_progress = [&](double share) { shares.push_back(share); };
  run_bench(small_suite(), with_constant(), control);
  EXPECT_EQ(shares.size(), 6U);
  EXPECT_EQ(shares.back(), 1.0);
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

TEST(RunBench, StatedPoseErrorReachesTheMethods) {
  std::optional<PoseErrorModel> stated;
  const std::vector<Method> methods = {
      hyperbola_method(),
      {"hear", "keeps what it is told", [&](const LocalizationProblem& problem, int, Diagnostics&) {
         stated = problem.pose_error;
         return LocalizationResult{};
       }}};
  Suite suite = small_suite();
  suite.count = 1;
  suite.methods = {{"hear", "hear", {}, {}}};
  suite.conditions.resize(1);
  suite.conditions[0].settings = {{"pose.source", "noisy"}, {"pose.sigma_m", "0.02"}};
  run_bench(suite, methods, on_threads(1));
  ASSERT_TRUE(stated);
  EXPECT_EQ(stated->sigma_m, 0.02);
  suite.conditions[0].believed = PoseErrorModel{0.04, 0.0, 10.0};
  run_bench(suite, methods, on_threads(1));
  EXPECT_EQ(stated.value().sigma_m, 0.04);
  suite.conditions[0].believed = UnknownPoseError{};
  run_bench(suite, methods, on_threads(1));
  EXPECT_FALSE(stated);
  // A method's own settings override the condition's.
  suite.conditions[0].believed = {};
  suite.methods[0].localization = {{"localization.pose_error", "{sigma_m: 0.07}"}};
  run_bench(suite, methods, on_threads(1));
  EXPECT_EQ(stated.value().sigma_m, 0.07);
}

TEST(RunBench, FaultsReachTheMethodsAndTheJudge) {
  std::set<double> phases;
  std::vector<Method> methods = with_constant();
  const LocateFunction constant = methods.back().locate;
  methods.back().locate = [&](const LocalizationProblem& problem, int threads,
                              Diagnostics& diagnostics) {
    for (const PhaseSample& sample : problem.samples.begin()->second.begin()->second) {
      phases.insert(sample.phase_rad);
    }
    return constant(problem, threads, diagnostics);
  };
  Suite suite = small_suite();
  suite.count = 1;
  suite.methods = {{"mine", "constant", {}, {}}};
  suite.conditions.resize(1);
  const Bench sound = run_bench(suite, methods, on_threads(1));
  EXPECT_GT(phases.size(), 10U);
  EXPECT_EQ(statistics_of(sound.entries[0]).false_claims, 0U);  // It states no expected error.
  EXPECT_TRUE(sound.conditions[0].faults.empty());
  phases.clear();
  suite.conditions[0].fault = Faults{};
  suite.conditions[0].fault->constant_phases = true;
  suite.conditions[0].fault->random_rssi = true;
  const Bench faulty = run_bench(suite, methods, on_threads(1));
  EXPECT_EQ(phases.size(), 1U);
  const EntryStatistics all = statistics_of(faulty.entries[0]);
  EXPECT_GT(all.located, 0U);
  EXPECT_EQ(all.false_claims, all.located);
  EXPECT_EQ(faulty.conditions[0].faults,
            (std::vector<std::string>{"constant_phases", "random_rssi"}));
  EXPECT_EQ(faulty.conditions[0].no_bound, "the reads are faulty");
}

/// A tag at (3, 4), which the constant method locates at (2, 0), as there are two reads of it; and
/// an unknown tag.
RecordedReads two_reads(const SuiteRecording& /*recording*/) {
  RecordedReads tables;
  for (const char* tag : {"a", "stranger", "a"}) {
    TagRead read;
    read.stamp = time_from_seconds(static_cast<double>(tables.reads.size()));
    read.antenna = "still";
    read.tag = tag;
    read.frequency_hz = 866e6;
    read.phase_rad = static_cast<double>(tables.reads.size());
    tables.reads.push_back(read);
  }
  AntennaPose pose;
  pose.antenna = "still";
  tables.poses = {pose};
  return tables;
}

TEST(RunBench, RecordingsAreJudgedByTheirTruth) {
  const std::string truth = ::testing::TempDir() + "run_bench_truth.csv";
  write_text_file(truth, "tag,x_m,y_m\na,3,4\nunread,1,1\n");
  Suite suite;
  suite.name = "recorded";
  suite.count = 5;
  suite.methods = {{"mine", "constant", {}, {}}};
  suite.conditions.resize(1);
  suite.conditions[0].name = "one";
  suite.conditions[0].recording = SuiteRecording{};
  suite.conditions[0].recording->reads = truth;  // It only has to exist.
  suite.conditions[0].recording->truth = truth;
  Diagnostics diagnostics;
  const Bench bench = run_bench(prepare(suite, with_constant(), diagnostics, two_reads), {});
  ASSERT_EQ(bench.entries[0].runs.size(), 1U);
  const std::vector<TagRecord>& tags = bench.entries[0].runs[0].tags;
  ASSERT_EQ(tags.size(), 2U);
  EXPECT_EQ(tags[0].tag, "a");
  EXPECT_EQ(tags[0].reads, 2U);
  EXPECT_NEAR(tags[0].error.value(), std::sqrt(17.0), 1e-12);
  EXPECT_EQ(tags[1].tag, "unread");
  EXPECT_EQ(tags[1].verdict, Verdict::kNotLocated);
  EXPECT_EQ(bench.conditions[0].pose, "given");
  EXPECT_EQ(bench.conditions[0].recording, "run_bench_truth.csv");
  EXPECT_FALSE(statistics_of(bench.entries[0]).ratio);
  EXPECT_THROW(run_bench(suite, with_constant(), {}), Error);
  suite.conditions[0].settings = {{"localization.stride_m", "1"}};
  EXPECT_THROW(prepare(suite, with_constant(), diagnostics, two_reads), Error);
}

}  // namespace
}  // namespace tagfield
