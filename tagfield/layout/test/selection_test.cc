// SPDX-License-Identifier: Apache-2.0
#include "tagfield/layout/selection.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/layout/test/random_problem.h"

namespace tagfield {
namespace {

constexpr std::size_t kCases = 30;

OptionSet sorted(std::vector<std::size_t> order) {
  std::sort(order.begin(), order.end());
  return order;
}

/// Two options that read half of one element each, one that reads the other.
SelectionProblem three_options() {
  SelectionProblem problem;
  problem.elements = {{0.5}, {0.5}};
  problem.options.resize(3);
  problem.options[0] = {0, kNoZone, 1.0, {{0, 0.5F}}, {}};
  problem.options[1] = {1, kNoZone, 1.0, {{0, 0.5F}}, {}};
  problem.options[2] = {2, kNoZone, 1.0, {{1, 0.75F}}, {}};
  problem.limits.antennas = 3;
  return problem;
}

TEST(Selection, ScoresByMissesMultiplied) {
  SelectionProblem problem = three_options();
  EXPECT_DOUBLE_EQ(score_of(problem, {}), 0.0);
  EXPECT_DOUBLE_EQ(score_of(problem, {0}), 0.25);
  EXPECT_DOUBLE_EQ(score_of(problem, {0, 1}), 0.375);
  EXPECT_DOUBLE_EQ(score_of(problem, {0, 1, 2}), 0.5);
  // Beyond the cap more is worth nothing.
  problem.cap = 0.5;
  EXPECT_DOUBLE_EQ(score_of(problem, {0, 1}), 0.5);
  EXPECT_EQ(greedy_order(problem), (std::vector<std::size_t>{0, 2}));
}

TEST(Selection, TakesTheGreatestGainFirst) {
  EXPECT_EQ(greedy_order(three_options()), (std::vector<std::size_t>{0, 1, 2}));
}

TEST(Selection, KeepsToItsLimits) {
  SelectionProblem problem = three_options();
  problem.limits.antennas = 2;
  EXPECT_EQ(broken_limit(problem, {0, 1, 2}), Limit::kAntennas);
  problem.options[1].site = 0;
  EXPECT_EQ(broken_limit(problem, {0, 1}), Limit::kSite);
  problem.limits.reader_cost = 10.0;
  problem.limits.ports = 1;
  EXPECT_DOUBLE_EQ(cost_of(problem, {0, 2}), 22.0);
  EXPECT_EQ(readers_of(problem, {0, 2}), 2U);
  problem.limits.cost = 21.0;
  EXPECT_EQ(broken_limit(problem, {0, 2}), Limit::kCost);
  problem.limits.readers = 1;
  EXPECT_EQ(broken_limit(problem, {0, 2}), Limit::kReaders);
}

TEST(Selection, CountsWhatOtherZonesRead) {
  SelectionProblem problem = three_options();
  problem.zones = 2;
  problem.elements[0].zone = 0;
  problem.elements[1].zone = 1;
  for (SelectionOption& option : problem.options) option.zone = 1;
  problem.options[0].crossings = {{0, 0.5F}};
  problem.options[1].crossings = {{0, 0.5F}};
  const std::vector<double> cross = cross_of(problem, {0, 1, 2});
  EXPECT_DOUBLE_EQ(cross[0], 0.75);
  EXPECT_DOUBLE_EQ(cross[1], 0.0);
  problem.limits.cross = 0.7;
  EXPECT_EQ(broken_limit(problem, {0, 1}), Limit::kCross);
  EXPECT_EQ(broken_limit(problem, {0, 2}), Limit::kNone);
}

TEST(Selection, GreedIsWithinItsBoundsOfTheBest) {
  for (std::uint64_t number = 0; number < kCases; ++number) {
    const SelectionProblem problem = random_problem(number, 12, 24);
    const double best = score_of(problem, best_by_trying(problem));
    const OptionSet greedy = sorted(greedy_order(problem));
    const double score = score_of(problem, greedy);
    EXPECT_EQ(broken_limit(problem, greedy), Limit::kNone) << number;
    EXPECT_LE(score, best + 1e-9) << number;
    // What is computed for the case holds for all choices within the limits.
    EXPECT_GE(upper_bound(problem, greedy), best - 1e-9) << number;
    if (const auto share = guaranteed_share(problem)) {
      EXPECT_GE(score, *share * best - 1e-9) << number;
    }
    const OptionSet better = exchanged(problem, greedy, 100);
    EXPECT_EQ(broken_limit(problem, better), Limit::kNone) << number;
    EXPECT_GE(score_of(problem, better), score - 1e-12) << number;
    EXPECT_LE(score_of(problem, better), best + 1e-9) << number;
  }
}

/// Without laziness.
std::vector<std::size_t> plainly_greedy(const SelectionProblem& problem) {
  std::vector<std::size_t> order;
  OptionSet choice;
  for (;;) {
    double most = 1e-12;
    std::size_t best = problem.options.size();
    for (std::size_t option = 0; option < problem.options.size(); ++option) {
      if (std::binary_search(choice.begin(), choice.end(), option)) continue;
      OptionSet more = choice;
      more.insert(std::upper_bound(more.begin(), more.end(), option), option);
      if (broken_limit(problem, more) != Limit::kNone) continue;
      const double gain = score_of(problem, more) - score_of(problem, choice);
      if (gain <= most + 1e-12) continue;
      most = gain;
      best = option;
    }
    if (best == problem.options.size()) return order;
    order.push_back(best);
    choice = sorted(order);
  }
}

TEST(Selection, LazinessChangesNothing) {
  for (std::uint64_t number = 0; number < kCases; ++number) {
    const SelectionProblem problem = random_problem(number, 20, 40);
    EXPECT_EQ(greedy_order(problem), plainly_greedy(problem)) << number;
  }
}

/// Submodular: an option adds no more to a choice than to a part of it.
RC_GTEST_PROP(Selection, GainsOnlyShrink, ()) {
  const auto number = *rc::gen::inRange<std::uint64_t>(0, 1000);
  const SelectionProblem problem = random_problem(number, 10, 16);
  const auto size = *rc::gen::inRange<std::size_t>(0, 8);
  OptionSet whole;
  for (std::size_t i = 0; i < size; ++i) whole.push_back(i);
  const OptionSet part(
      whole.begin(),
      whole.begin() + static_cast<std::ptrdiff_t>(*rc::gen::inRange<std::size_t>(0, size + 1)));
  const auto gain = [&](const OptionSet& choice) {
    OptionSet more = choice;
    more.push_back(9);
    return score_of(problem, more) - score_of(problem, choice);
  };
  RC_ASSERT(gain(part) >= gain(whole) - 1e-12);
  RC_ASSERT(gain(whole) >= -1e-12);
}

}  // namespace
}  // namespace tagfield
