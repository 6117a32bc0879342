// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/sweep/sweep_plan.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <map>
#include <set>

#include "tagfield/base/error.h"
#include "tagfield/base/number.h"
#include "tagfield/experiment/sweep/design.h"

namespace tagfield {
namespace {

Suite suite_with(const SweepDesign& design, std::uint64_t seeds = 4) {
  Condition condition;
  condition.name = "plain";
  condition.scenario = "none.yaml";
  Suite suite;
  suite.first_seed = 10;
  suite.count = seeds;
  suite.methods = {{"ml", "ml", {}, {}}};
  suite.conditions = {condition};
  suite.sweep = std::make_shared<SweepDesign>(design);
  return suite;
}

SweepDesign list_of(std::size_t points) {
  ListDesign list;
  for (std::size_t i = 0; i < points; ++i) list.points.push_back({{"key", std::to_string(i)}});
  return {list, {}, {}};
}

TEST(SweepPlan, GridIsEveryCombinationTheLastKeyFastest) {
  const NumberSpan span{1.0, 100.0, true, false, 3};
  const SweepPlan plan = planned(suite_with(
      {GridDesign{{{"a", span, {}}, {"b", std::vector<std::string>{"x", "y"}, {}}}}, {}, {}}));
  std::vector<std::string> names;
  for (const SweepPoint& point : plan.points) names.push_back(point.name);
  EXPECT_EQ(names, (std::vector<std::string>{"a=1, b=x", "a=1, b=y", "a=10, b=x", "a=10, b=y",
                                             "a=100, b=x", "a=100, b=y"}));
  EXPECT_EQ(plan.keys, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(value_at(plan.points[3], "b"), "y");
  EXPECT_EQ(value_at(plan.points[3], "c"), "");
}

TEST(SweepPlan, IntegersAreRounded) {
  const auto values = [](const SweepPlan& plan) {
    std::vector<std::string> found;
    for (const SweepPoint& point : plan.points) found.push_back(value_at(point, "a"));
    return found;
  };
  // 1, 10^0.5, 10, 10^1.5 and 100.
  const NumberSpan steps{1.0, 100.0, true, true, 5};
  EXPECT_EQ(values(planned(suite_with({GridDesign{{{"a", steps, {}}}}, {}, {}}))),
            (std::vector<std::string>{"1", "3", "10", "32", "100"}));
  // Forty strata of 0.1 from 0 to 4: five round to 0, ten each to 1, 2 and 3, five to 4.
  const NumberSpan span{0.0, 4.0, false, true, 0};
  const LatinHypercubeDesign hypercube{40, 7, {{"a", span, {}}}};
  std::map<std::string, int> counts;
  for (const std::string& value : values(planned(suite_with({hypercube, {}, {}})))) ++counts[value];
  EXPECT_EQ(counts,
            (std::map<std::string, int>{{"0", 5}, {"1", 10}, {"2", 10}, {"3", 10}, {"4", 5}}));
}

TEST(SweepPlan, MoreIntegerStepsThanIntegersAreRefused) {
  const NumberSpan steps{1.0, 3.0, false, true, 5};
  EXPECT_THROW(planned(suite_with({GridDesign{{{"a", steps, {}}}}, {}, {}})), Error);
}

TEST(SweepPlan, SuiteWithoutASweepHasAPointForEachCondition) {
  Suite suite = suite_with({});
  suite.sweep.reset();
  suite.conditions.push_back(suite.conditions[0]);
  suite.conditions[1].name = "other";
  suite.conditions[1].count = 2;
  const SweepPlan plan = planned(suite);
  ASSERT_EQ(plan.points.size(), 2U);
  EXPECT_EQ(plan.points[1].name, "other");
  EXPECT_EQ(runs_of(plan, {}).size(), 6U);
  EXPECT_EQ(suite_of_point(plan, 1).conditions.at(0).name, "other");
  EXPECT_EQ(suite_of_point(plan, 1).count, 2U);
}

/// The defining property, whatever the number of points and the seed.
RC_GTEST_PROP(SweepPlan, LatinHypercubeHasOnePointInEachStratum, ()) {
  const auto points = *rc::gen::inRange<std::size_t>(1, 200);
  const auto seed = *rc::gen::arbitrary<std::uint64_t>();
  const NumberSpan span{-3.0, 5.0, false, false, 0};
  const SweepPlan plan = planned(
      suite_with({LatinHypercubeDesign{points, seed, {{"a", span, {}}, {"b", span, {}}}}, {}, {}}));
  for (const char* key : {"a", "b"}) {
    std::vector<double> values;
    for (const SweepPoint& point : plan.points) {
      values.push_back(parse_number(value_at(point, key)).value());
    }
    std::sort(values.begin(), values.end());
    for (std::size_t i = 0; i < points; ++i) {
      const double stratum = 8.0 / static_cast<double>(points);
      // Values are written with six digits.
      RC_ASSERT(values[i] >= -3.0 + stratum * static_cast<double>(i) - 1e-5);
      RC_ASSERT(values[i] <= -3.0 + stratum * static_cast<double>(i + 1) + 1e-5);
    }
  }
}

TEST(SweepPlan, LatinHypercubeKeysAreNotTiedTogether) {
  const NumberSpan span{0.0, 1.0, false, false, 0};
  const SweepPlan plan = planned(
      suite_with({LatinHypercubeDesign{2000, 1, {{"a", span, {}}, {"b", span, {}}}}, {}, {}}));
  double sum = 0.0;
  for (const SweepPoint& point : plan.points) {
    sum += (parse_number(value_at(point, "a")).value() - 0.5) *
           (parse_number(value_at(point, "b")).value() - 0.5);
  }
  // For independent keys the correlation has a standard deviation of 1/√2000; this is five times
  // that.
  EXPECT_LT(std::abs(12.0 * sum / 2000.0), 5.0 / std::sqrt(2000.0));
}

/// Each run is in one shard, and the sizes of shards differ by at most one.
RC_GTEST_PROP(SweepPlan, ShardsTakeEachRunOnce, ()) {
  const SweepPlan plan = planned(suite_with(list_of(*rc::gen::inRange<std::size_t>(1, 30))));
  const std::vector<RunKey> runs = runs_of(plan, {});
  const auto count = *rc::gen::inRange<std::size_t>(1, 50);
  std::multiset<RunKey> taken;
  for (std::size_t shard = 1; shard <= count; ++shard) {
    const std::vector<RunKey> own = runs_of_shard(runs, shard, count);
    RC_ASSERT(own.size() == runs.size() / count || own.size() == runs.size() / count + 1);
    taken.insert(own.begin(), own.end());
  }
  RC_ASSERT(taken == std::multiset<RunKey>(runs.begin(), runs.end()));
}

TEST(SweepPlan, RungsHaveFewerPointsAndMoreSeeds) {
  SweepDesign design = list_of(27);
  design.adaptive = Halving{SweepTarget::kMean, "ml", 2, 3};
  const SweepPlan plan = planned(suite_with(design, 20));
  EXPECT_EQ(rung_seeds(plan), (std::vector<std::uint64_t>{2, 6, 18, 20}));
  EXPECT_EQ(rung_points(plan), (std::vector<std::size_t>{27, 9, 3, 1}));
  EXPECT_EQ(runs_of(plan, {}).size(), 54U);
  const ClosedRungs closed{{{1, 5, 9, 10, 11, 12, 13, 14, 26}}};
  const std::vector<RunKey> runs = runs_of(plan, closed);
  ASSERT_EQ(runs.size(), 54U + 9U * 4U);
  EXPECT_EQ(runs[54], (RunKey{1, 12}));
  EXPECT_EQ(runs.back(), (RunKey{26, 15}));
  EXPECT_EQ(std::set<RunKey>(runs.begin(), runs.end()).size(), runs.size());
}

TEST(SweepPlan, BestAreThoseOfLeastScoreAndOfEqualOnesTheFirst) {
  EXPECT_EQ(best_of({{0, 2.0}, {1, 1.0}, {2, 1.0}, {3, 5.0}, {4, 1.0}}, 3),
            (std::vector<std::uint64_t>{1, 2}));
  EXPECT_EQ(best_of({{7, 3.0}}, 3), (std::vector<std::uint64_t>{7}));
}

}  // namespace
}  // namespace tagfield
