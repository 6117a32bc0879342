// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/comparison.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tagfield/base/error.h"
#include "tagfield/report/comparison_page.h"
#include "tagfield/report/test/balanced_tags.h"

namespace tagfield {
namespace {

/// A tag at (x, 0, 0), located with `error_m`; none for not located.
TagOutcome located(const std::string& tag, double x, std::optional<double> error_m,
                   std::uint64_t seed = 1) {
  TagOutcome outcome;
  outcome.seed = seed;
  outcome.estimate.tag = tag;
  outcome.reads = 10;
  outcome.truth_m = Eigen::Vector3d(x, 0, 0);
  if (!error_m) return outcome;
  outcome.estimate.verdict = Verdict::kLocated;
  outcome.estimate.candidates.resize(1);
  outcome.estimate.candidates.front().p_WT = {x, *error_m, 0};
  return outcome;
}

Summary run_of(const std::vector<TagOutcome>& tags, std::vector<std::uint64_t> seeds = {1}) {
  Summary summary;
  summary.scenario = "hall";
  summary.method = "hyperbola";
  summary.pose = "true";
  summary.seeds = std::move(seeds);
  summary.tags = tags;
  return summary;
}

TEST(RunComparison, PairsErrorsTagByTag) {
  const Summary first = run_of({located("tag2", 0, 0.010), located("tag10", 1, 0.020),
                                located("tag3", 2, 0.030), located("tag4", 3, std::nullopt)});
  const Summary second = run_of({located("tag2", 0, 0.008), located("tag10", 1, 0.012),
                                 located("tag3", 2, 0.032), located("tag4", 3, 0.5)});
  const RunComparison comparison = compared(first, "a", second, "b");
  ASSERT_EQ(comparison.tags.size(), 4U);
  EXPECT_EQ(comparison.tags[0].tag, "tag2");
  EXPECT_EQ(comparison.tags[3].tag, "tag10");
  EXPECT_EQ(comparison.tags[2].runs[0].verdict, "not located");
  EXPECT_EQ(comparison.tags[2].runs[1].verdict, "located");
  EXPECT_EQ(comparison.runs[0].located, 3U);
  EXPECT_EQ(comparison.runs[1].located, 4U);
  ASSERT_TRUE(comparison.error);
  EXPECT_EQ(comparison.error->tags, 3U);
  EXPECT_EQ(comparison.error->smaller, 2U);
  EXPECT_EQ(comparison.error->larger, 1U);
  // -2, -8 and +2 mm: mean -8/3, s = 5.033, t(2) = 4.303, so ± 12.503 mm.
  EXPECT_NEAR(comparison.error->mean_m, -0.008 / 3.0, 1e-12);
  ASSERT_TRUE(comparison.error->interval_m);
  EXPECT_NEAR((*comparison.error->interval_m)[0], -0.008 / 3.0 - 0.012503, 1e-6);
  EXPECT_NEAR((*comparison.error->interval_m)[1], -0.008 / 3.0 + 0.012503, 1e-6);
  EXPECT_TRUE(comparison.warnings.empty());
  EXPECT_EQ(comparison_sentence(comparison),
            "Of 3 tags that both located, the second run has the smaller error for 2 and the "
            "larger for 1. Its errors differ by −2.7 mm on average (−15 mm to +9.8 mm with 95 % "
            "confidence), which may be chance.");
}

TEST(RunComparison, TakesTheMeanOverSeeds) {
  const Summary first = run_of({located("t", 0, 0.01, 1), located("t", 0, 0.03, 2)}, {1, 2});
  const Summary second =
      run_of({located("t", 0, 0.05, 1), located("t", 0, std::nullopt, 2)}, {1, 2});
  const RunComparison comparison = compared(first, "a", second, "b");
  EXPECT_NEAR(*comparison.tags.front().runs[0].error_m, 0.02, 1e-12);
  EXPECT_NEAR(*comparison.tags.front().runs[1].error_m, 0.05, 1e-12);
  EXPECT_EQ(comparison.tags.front().runs[0].reads, 20U);
  EXPECT_EQ(comparison.tags.front().runs[1].verdict, "located in 1 of 2");
  EXPECT_FALSE(comparison.error->interval_m);
}

/// An inventory of tags "a", "b", … with their reads by seed.
Summary inventory_run(const std::vector<std::vector<std::size_t>>& reads) {
  Summary summary = run_of({}, {});
  summary.method = "none";
  summary.inventory.emplace();
  for (std::size_t seed = 1; seed <= reads.front().size(); ++seed) {
    summary.seeds.push_back(seed);
    for (std::size_t i = 0; i < reads.size(); ++i) {
      TagOutcome tag = located(std::string(1, static_cast<char>('a' + i)), 0, std::nullopt, seed);
      tag.reads = reads[i][seed - 1];
      summary.tags.push_back(tag);
    }
  }
  return summary;
}

TEST(RunComparison, OfInventoriesIsOfReadsAlone) {
  const Summary all = inventory_run({{10, 20}, {5, 4}, {1, 1}});
  const Summary fewer = inventory_run({{10, 3}, {0, 0}, {0, 2}});
  const RunComparison several = compared(all, "a", fewer, "b");
  // Two of three tags were read in one run and one in the other.
  EXPECT_EQ(comparison_sentence(several),
            "3 and 1.5 of 3 tags were read, on average over the seeds.");
  EXPECT_EQ(several.tags[0].runs[1].verdict, "read in 2 of 2");
  EXPECT_EQ(several.tags[2].runs[1].verdict, "read in 1 of 2");
  const std::string page = comparison_page(several, comparison_figures(several, {}));
  EXPECT_EQ(unbalanced_tag(page), "");
  for (const char* word : {"ocated", "error [mm]", "ean error", "known error"}) {
    EXPECT_EQ(page.find(word), std::string::npos) << word;
  }
  EXPECT_NE(page.find("<td>20.5</td><td>7.5</td><td>−13</td>"), std::string::npos);
  EXPECT_NE(page.find("<td>15</td><td>6.5</td>"), std::string::npos);

  const RunComparison one =
      compared(inventory_run({{9}, {4}}), "a", inventory_run({{0}, {4}}), "b");
  EXPECT_EQ(comparison_sentence(one), "2 and 1 of 2 tags were read.");
  EXPECT_EQ(one.tags[0].runs[0].verdict, "read");
  EXPECT_EQ(one.tags[0].runs[1].verdict, "not read");
  const RunComparison unequal = compared(inventory_run({{9}, {4}}), "a", inventory_run({{0}}), "b");
  EXPECT_EQ(comparison_sentence(unequal), "2 of 2 and 0 of 1 tags were read.");
  // Beside a run that locates, errors stay.
  const RunComparison mixed =
      compared(inventory_run({{9}}), "a", run_of({located("a", 0, 0.01)}), "b");
  EXPECT_EQ(mixed.tags[0].runs[1].verdict, "located");
  EXPECT_NE(comparison_page(mixed, {}).find("Tags located"), std::string::npos);
}

TEST(RunComparison, WarnsOfWhatCannotBeCompared) {
  const Summary first = run_of({located("a", 0, 0.01), located("b", 1, 0.01)});
  Summary second = run_of({located("b", 1.5, 0.01), located("c", 2, 0.01)}, {2});
  second.complete = false;
  const RunComparison comparison = compared(first, "a", second, "b");
  EXPECT_EQ(comparison.tags.back().runs[0].verdict, "not there");
  const std::vector<std::string> expected = {
      "1 tag in the first run alone", "1 tag in the second run alone",
      "1 tag is at another true position in the second run: each run is judged by its own truth",
      "the runs have different seeds: a part of the difference is chance",
      "the second run was interrupted"};
  EXPECT_EQ(comparison.warnings, expected);
  EXPECT_THROW(compared(first, "a", run_of({located("z", 0, 0.1)}), "b"), Error);
}

TEST(RunComparison, JudgesARecordingByTheOtherRunsTruth) {
  const Summary first = run_of({located("a", 0, 0.01), located("b", 1, 0.01)});
  Summary second = run_of({located("a", 0, 0.03), located("b", 1, 0.02)}, {});
  for (TagOutcome& outcome : second.tags) outcome.truth_m.reset();
  for (const bool swapped : {false, true}) {
    const RunComparison comparison =
        swapped ? compared(second, "b", first, "a") : compared(first, "a", second, "b");
    ASSERT_TRUE(comparison.error);
    EXPECT_NEAR(comparison.error->mean_m, swapped ? -0.015 : 0.015, 1e-12);
    ASSERT_EQ(comparison.warnings.size(), 1U);
    EXPECT_EQ(
        comparison.warnings.front(),
        swapped ? "the first run does not know where 2 tags are: judged by the second run's truth"
                : "the second run does not know where 2 tags are: judged by the first run's truth");
  }
}

TEST(RunComparison, IsJsonAndTable) {
  const Summary first = run_of({located("a,1", 0, 0.01), located("b", 1, std::nullopt)});
  const Summary second = run_of({located("a,1", 0, 0.04), located("b", 1, 0.01)});
  const RunComparison comparison = compared(first, "one", second, "two");
  EXPECT_EQ(
      comparison_to_csv(comparison),
      "tag,first_reads,second_reads,first_verdict,second_verdict,first_error_m,second_error_m,"
      "difference_m\n"
      "\"a,1\",10,10,located,located,0.01,0.04,0.03\n"
      "b,10,10,not located,located,,0.01,\n");
  const auto json = nlohmann::json::parse(comparison_to_json(comparison));
  EXPECT_EQ(json["runs"][1]["name"], "two");
  EXPECT_EQ(json["tags"][1]["runs"][0]["error_m"], nullptr);
  EXPECT_DOUBLE_EQ(json["error_difference_m"]["mean"], 0.03);
  EXPECT_EQ(json["error_difference_m"]["low"], nullptr);
}

TEST(ComparisonPage, HoldsAllAndNothingBreaksOut) {
  // A few tags are drawn as rows, many as a cloud of dots.
  for (const int count : {3, 60}) {
    std::vector<TagOutcome> one;
    std::vector<TagOutcome> other;
    for (int i = 0; i < count; ++i) {
      const std::string tag = "<b>" + std::to_string(i);
      one.push_back(located(tag, i, 0.01 + 0.001 * i));
      other.push_back(located(tag, i, 0.01));
    }
    const RunComparison comparison = compared(run_of(one), "<i>one", run_of(other), "two");
    const std::vector<Figure> figures = comparison_figures(comparison, {});
    ASSERT_EQ(figures.size(), 2U);
    for (const Figure& figure : figures) EXPECT_EQ(figure.missing, "");
    const std::string page = comparison_page(comparison, figures);
    EXPECT_EQ(unbalanced_tag(page), "");
    EXPECT_EQ(page.find("<i>one"), std::string::npos);
    EXPECT_EQ(page.find("<b>0"), std::string::npos);
    EXPECT_EQ(page.find("nan"), std::string::npos);
    EXPECT_NE(page.find("&lt;i&gt;one"), std::string::npos);
  }
  const RunComparison none = compared(run_of({located("a", 0, std::nullopt)}), "x",
                                      run_of({located("a", 0, std::nullopt)}), "y");
  for (const Figure& figure : comparison_figures(none, {})) EXPECT_NE(figure.missing, "");
}

}  // namespace
}  // namespace tagfield
