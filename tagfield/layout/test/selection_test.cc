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

/// Two options that each read the first element with probability ½, and one that reads the second.
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
  EXPECT_EQ(met_by(problem, {0, 1, 2}), (std::vector<double>{0.75, 0.25}));
  // Above the cap, more is worth nothing.
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

TEST(Selection, CountsReadsUpToTheCap) {
  SelectionProblem problem = three_options();
  problem.worth = Worth::kReads;
  problem.cap = 4.0;
  problem.options[0].reads = {{0, 1.0F}};
  problem.options[1].reads = {{0, 5.0F}};
  problem.options[2].reads = {{1, 2.0F}};
  EXPECT_DOUBLE_EQ(score_of(problem, {0}), 0.125);
  EXPECT_DOUBLE_EQ(score_of(problem, {0, 1, 2}), 0.5 + 0.25);
  EXPECT_EQ(greedy_order(problem), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(met_by(problem, {0, 1, 2}), (std::vector<double>{1.0, 0.0}));
}

TEST(Selection, CountsInformationAboutPlaces) {
  // Distances along x, y and the diagonal, known to 0.1, 0.2 and 0.1 m.
  SelectionProblem problem = three_options();
  problem.worth = Worth::kPlace;
  problem.spread_m = 1.0;
  problem.error_m = 0.2;
  problem.options[0].information = {{0, 100.0F, 0.0F, 0.0F}};
  problem.options[1].information = {{0, 0.0F, 0.0F, 25.0F}};
  problem.options[2].information = {{0, 50.0F, 50.0F, 50.0F}};
  // Half of ln det J/J₀ relative to that for an error of 0.1 m: 1/200 m² along each axis.
  EXPECT_NEAR(score_of(problem, {0}), 0.5 * std::log(101.0) / (2.0 * std::log(200.0)), 1e-12);
  EXPECT_NEAR(score_of(problem, {0, 1}), 0.5 * std::log(101.0 * 26.0) / (2.0 * std::log(200.0)),
              1e-12);
  // Two distances leave two possible positions; for three, √tr J⁻¹ with J = [150 50; 50 75].
  const SelectionOption* const all = problem.options.data();
  EXPECT_TRUE(std::isinf(error_bound_m({all[0].information[0], all[1].information[0]})));
  EXPECT_NEAR(error_bound_m({all[0].information[0], all[1].information[0], all[2].information[0]}),
              std::sqrt(225.0 / (150.0 * 75.0 - 2500.0)), 1e-9);
  // Three antennas in a line give information in one direction only.
  EXPECT_TRUE(std::isinf(
      error_bound_m({all[0].information[0], all[0].information[0], all[0].information[0]})));
  EXPECT_EQ(met_by(problem, {0, 1, 2}), (std::vector<double>{1.0, 0.0}));
  problem.error_m = 0.15;
  EXPECT_EQ(met_by(problem, {0, 1, 2}), (std::vector<double>{0.0, 0.0}));
}

constexpr Worth kAllWorths[] = {Worth::kProbability, Worth::kReads, Worth::kPlace};

TEST(Selection, GreedIsWithinItsBoundsOfTheBest) {
  for (std::uint64_t number = 0; number < 3 * kCases; ++number) {
    const SelectionProblem problem = random_problem(number / 3, 12, 24, kAllWorths[number % 3]);
    const double best = score_of(problem, best_by_trying(problem));
    const OptionSet greedy = sorted(greedy_order(problem));
    const double score = score_of(problem, greedy);
    EXPECT_EQ(broken_limit(problem, greedy), Limit::kNone) << number;
    EXPECT_LE(score, best + 1e-9) << number;
    // The bound computed for this problem holds for all choices within the limits.
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

/// Greedy selection without lazy evaluation.
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
  for (std::uint64_t number = 0; number < 3 * kCases; ++number) {
    const SelectionProblem problem = random_problem(number / 3, 20, 40, kAllWorths[number % 3]);
    EXPECT_EQ(greedy_order(problem), plainly_greedy(problem)) << number;
  }
}

/// Submodularity: an option adds no more to a choice than to a subset of it.
RC_GTEST_PROP(Selection, GainsOnlyShrink, ()) {
  const auto number = *rc::gen::inRange<std::uint64_t>(0, 1000);
  const Worth worth = kAllWorths[*rc::gen::inRange<std::size_t>(0, 3)];
  const SelectionProblem problem = random_problem(number, 10, 16, worth);
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
