// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/store/run_store.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/bench_files.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/experiment.h"
#include "tagfield/experiment/store/method_runs_json.h"
#include "tagfield/experiment/store/seed_run_json.h"
#include "tagfield/experiment/store/work_hash.h"
#include "tagfield/files/files.h"
#include "tagfield/localization/locate.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;

const std::string kSmallScenario = TAGFIELD_SOURCE_DIR "/scenarios/z_axis.yaml";
const LogHead kStoreHead{"1", "a"};

/// A folder of the test's own.
class RunStoreTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = fs::temp_directory_path() / "tagfield_run_store_test";
    fs::remove_all(folder_);
    fs::create_directories(folder_);
  }
  void TearDown() override { fs::remove_all(folder_); }
  [[nodiscard]] std::string path(const std::string& name) const {
    return (folder_ / name).string();
  }

  fs::path folder_;
  Diagnostics diagnostics_;
};

TagRecord odd_record() {
  TagRecord tag;
  tag.tag = "a \"tag\"\n";
  tag.verdict = Verdict::kLocated;
  tag.reads = 12;
  tag.truth = Eigen::Vector3d(0.1, -1e-300, 3.0);
  tag.expected_error = std::numeric_limits<double>::infinity();
  tag.error = 1.0 / 3.0;
  tag.bound = TagBound{0.1, std::nextafter(0.2, 1.0)};
  tag.nees = Nees{std::numeric_limits<double>::quiet_NaN(), 3};
  tag.false_claim = true;
  tag.claims_no_error = true;
  tag.flat_covariance = true;
  return tag;
}

TEST(MethodRunsJson, GivesBackEachBit) {
  MethodRun run;
  run.seed = 18446744073709551615U;
  run.method = "joint";
  run.bound = BoundKind::kJoint;
  run.nees_correlation = 0.1 + 0.2;
  run.seconds = 1e-9;
  run.tags_given = 3;
  run.tags = {odd_record(), TagRecord{}};
  const std::string line = to_json_line({{run, run}, {"odd"}});
  EXPECT_EQ(line.find('\n'), std::string::npos);
  const ConditionRun back = condition_run_in(line, {});
  ASSERT_EQ(back.methods.size(), 2U);
  EXPECT_EQ(back.warnings, (std::vector<std::string>{"odd"}));
  const MethodRun& other = back.methods[1];
  EXPECT_EQ(other.seed, run.seed);
  EXPECT_EQ(other.bound, run.bound);
  EXPECT_EQ(other.nees_correlation, run.nees_correlation);
  const TagRecord& tag = other.tags.at(0);
  EXPECT_EQ(tag.tag, run.tags[0].tag);
  EXPECT_EQ(tag.truth, run.tags[0].truth);
  EXPECT_EQ(tag.error, run.tags[0].error);
  EXPECT_EQ(tag.bound->variance_m2, run.tags[0].bound->variance_m2);
  EXPECT_TRUE(std::isinf(tag.expected_error));
  EXPECT_TRUE(std::isnan(tag.nees->value));
  EXPECT_TRUE(tag.claims_no_error);
  EXPECT_TRUE(tag.flat_covariance);
  EXPECT_FALSE(other.tags.at(1).error.has_value());
  EXPECT_EQ(to_json_line(back), line);
}

TEST(MethodRunsJson, ComplainsOfOtherText) {
  for (const char* text : {"", "{}", "[1]", R"({"methods": [{"seed": 1}], "warnings": []})"}) {
    EXPECT_THROW(condition_run_in(text, {"log", 3}), Error) << text;
  }
}

TEST_F(RunStoreTest, KeptSeedsMakeTheSameSummary) {
  const Scenario scenario = load_scenario(
      kSmallScenario,
      {{"pose.source", "noisy"}, {"pose.sigma_m", "0.01"}, {"localization.compare", "[ml]"}});
  Diagnostics whole_warnings;
  const auto whole = run_seeds(scenario, 3, 4, {}, whole_warnings);
  const std::string log = path("resume.log");
  {
    RunStore store(log, kStoreHead, Resume::kNo, diagnostics_);
    run_seeds(scenario, 3, 2, {}, diagnostics_, nullptr, &store);
  }
  RunStore store(log, kStoreHead, Resume::kYes, diagnostics_);
  EXPECT_EQ(store.found(), 1U);  // The first seed is always rerun.
  Diagnostics warnings;
  const auto resumed = run_seeds(scenario, 3, 4, {}, warnings, nullptr, &store);
  EXPECT_EQ(to_json(summarize(scenario, resumed, 1.0, warnings)),
            to_json(summarize(scenario, whole, 1.0, whole_warnings)));
  store.drop();
  EXPECT_FALSE(fs::exists(log));
}

TEST_F(RunStoreTest, KeptRunsMakeTheSameBench) {
  Condition condition;
  condition.name = "plain";
  condition.scenario = kSmallScenario;
  Suite suite;
  suite.name = "small";
  suite.count = 3;
  suite.methods = {{"ml", "ml", {}, {}}, {"joint", "joint", {}, {}}};
  suite.conditions = {condition};
  const auto benched = [&](RunStore* store) {
    const PreparedSuite prepared = prepare(suite, built_in_methods(), diagnostics_);
    const Bench bench = run_bench(prepared, {}, store);
    return bench_to_json(bench, Timing::kWithoutTimes) + bench_tags_to_csv(bench);
  };
  const std::string whole = benched(nullptr);
  const std::string log = path("resume.log");
  {
    RunStore store(log, kStoreHead, Resume::kNo, diagnostics_);
    EXPECT_EQ(benched(&store), whole);
  }
  RunStore store(log, kStoreHead, Resume::kYes, diagnostics_);
  EXPECT_EQ(store.found(), 3U);
  EXPECT_EQ(benched(&store), whole);
}

TEST_F(RunStoreTest, SaysWhatIsDroppedWithoutResume) {
  const std::string log = path("resume.log");
  {
    RunStore store(log, kStoreHead, Resume::kNo, diagnostics_);
    store.add({0, 1}, "{}");
  }
  EXPECT_TRUE(diagnostics_.warnings().empty());
  const RunStore store(log, {"1", "other"}, Resume::kNo, diagnostics_);
  ASSERT_EQ(diagnostics_.warnings().size(), 1U);
  EXPECT_NE(diagnostics_.warnings()[0].find("--resume would have continued"), std::string::npos);
  EXPECT_EQ(store.find({0, 1}), nullptr);
}

/// Any change of what results depend on changes the hash, and nothing else does.
TEST_F(RunStoreTest, HashFollowsTheFiles) {
  const std::string scenario = path("a.yaml");
  const std::string world = path("w.sdf");
  const std::string included = path("m.sdf");
  const auto write = [&](const std::string& rate, const std::string& size) {
    write_text_file(included,
                    "<sdf version='1.7'><model name='m'><static>true</static><link "
                    "name='l'><collision name='c'><geometry><box><size>" +
                        size + "</size></box></geometry></collision></link></model></sdf>");
    write_text_file(world,
                    "<sdf version='1.7'><world name='w'><include><uri>m.sdf</uri></include>"
                    "</world></sdf>");
    write_text_file(scenario,
                    "world: {path: w.sdf}\nduration_s: 1\nmodel: paper\nantennas: [{name: "
                    "a, pose: [0, 0, 1, 0, 0, 0], rate_hz: " +
                        rate + "}]\ntags: [{id: t, position: [2, 2, 1]}]\n");
  };
  const auto hash_of = [&](const std::vector<Override>& overrides,
                           const std::vector<std::string>& words) {
    Diagnostics unheard;
    const Scene scene = load_scenario_with_world(scenario, overrides, unheard).scene;
    return work_hash(scenario, overrides, scene, words);
  };
  write("10", "1 1 1");
  const std::string hash = hash_of({}, {});
  EXPECT_EQ(hash.size(), 16U);
  write("10", "1 1 1");
  EXPECT_EQ(hash_of({}, {}), hash);
  EXPECT_NE(hash_of({{"tags.t.position", "[2, 2, 2]"}}, {}), hash);
  EXPECT_NE(hash_of({}, {"a*"}), hash);
  write("20", "1 1 1");
  EXPECT_NE(hash_of({}, {}), hash);
  write("10", "1 1 2");  // In a file that is named only by the world.
  EXPECT_NE(hash_of({}, {}), hash);
}

}  // namespace
}  // namespace tagfield
