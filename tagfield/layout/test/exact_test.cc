// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/layout/selection.h"
#include "tagfield/layout/test/random_problem.h"

namespace tagfield {
namespace {

constexpr double kEnough_s = 60.0;

TEST(ExactSelection, IsWhatTryingAllSays) {
  if (!has_exact_solver()) GTEST_SKIP() << "built without CBC";
  for (std::uint64_t number = 0; number < 60; ++number) {
    const Worth worth = number % 2 == 0 ? Worth::kProbability : Worth::kReads;
    const SelectionProblem problem = random_problem(number / 2, 10, 12, worth);
    const double best = score_of(problem, best_by_trying(problem));
    const ExactChoice exact = best_exactly(problem, {}, kEnough_s);
    EXPECT_EQ(broken_limit(problem, exact.choice), Limit::kNone) << number;
    EXPECT_NEAR(score_of(problem, exact.choice), best, 1e-6) << number;
    EXPECT_NEAR(exact.bound, best, 1e-5) << number;
  }
}

TEST(ExactSelection, HasABoundWhereTimeIsUp) {
  if (!has_exact_solver()) GTEST_SKIP() << "built without CBC";
  const SelectionProblem problem = random_problem(4, 12, 24);
  const OptionSet begin = greedy_order(problem);
  const ExactChoice none = best_exactly(problem, {}, 0.0);
  EXPECT_TRUE(none.choice.empty());
  EXPECT_GE(none.bound, score_of(problem, best_by_trying(problem)));
}

TEST(ExactSelection, KnowsNoPlaces) {
  if (!has_exact_solver()) GTEST_SKIP() << "built without CBC";
  EXPECT_THROW(best_exactly(random_problem(1, 10, 12, Worth::kPlace), {}, kEnough_s), Error);
}

TEST(ExactSelection, IsRefusedWithoutASolver) {
  if (has_exact_solver()) GTEST_SKIP() << "built with CBC";
  EXPECT_THROW(best_exactly({}, {}, 1.0), Error);
}

}  // namespace
}  // namespace tagfield
