// SPDX-License-Identifier: Apache-2.0
/// How often methods claim wrong positions, and whether their expected errors are right, on random
/// surveys: five tags; paths of six kinds, one or two antennas, 1 to 9 channels, and with some
/// chance a π ambiguity, heights to be estimated, and stated pose errors of up to 3 cm. More of
/// them:
///
///     TAGFIELD_SURVEYS=300 build/release/bin/localization_test --gtest_filter='RandomSurveys.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "survey_claims.h"

namespace tagfield::made {
namespace {

bool happens(double chance, Rng& rng) { return uniform(rng, 0.0, 1.0) < chance; }

int any_of(int count, Rng& rng) { return static_cast<int>(uniform(rng, 0.0, count)); }

Path any_path(Rng& rng) {
  const double step = uniform(rng, 0.015, 0.04);
  const double length = uniform(rng, 5.0, 14.0);
  const double first = uniform(rng, 1.0, 3.0);
  const double second = uniform(rng, 1.0, 3.0);
  switch (any_of(6, rng)) {
    case 0:
      return s_curve(length, step);
    case 1:
      return loop(length, step);
    case 2:
      return l_turn(0.3 * length, 0.6 * length, step);
    case 3:
      return rectangle(first, second, length, step);
    case 4:
      return straight(0.6 * length, step, 2.0 * first);
    default:
      return follow(length, step, [](double s) { return 0.4 * std::sin(s); });
  }
}

SurveyPlan any_plan(bool with_strays, Rng& rng) {
  SurveyPlan plan;
  plan.path = any_path(rng);
  if (happens(0.4, rng)) {
    plan.antennas = {{"left", {0.1, 0.2, 0.0}, kPi / 2.0}, {"right", {0.1, -0.2, 0.3}, -kPi / 2.0}};
  }
  if (happens(0.4, rng)) {
    plan.channels = 2 + any_of(8, rng);
    plan.dwell = 1 + any_of(30, rng);
  }
  plan.pi_ambiguity = happens(0.25, rng);
  plan.tags = 5;
  plan.nearest_m = 0.5;
  plan.farthest_m = 4.0;
  if (happens(0.3, rng)) {
    plan.lowest_m = 0.45;
    plan.highest_m = 2.0;
  }
  plan.range_m = uniform(rng, 3.5, 7.0);
  plan.phase_noise_rad = uniform(rng, 0.03, 0.3);
  if (happens(0.4, rng)) plan.pose_m = uniform(rng, 0.003, 0.03);
  plan.lost = uniform(rng, 0.0, 0.7);
  if (with_strays) plan.strays = uniform(rng, 0.0, 0.1);
  return plan;
}

unsigned count_of_surveys() {
  constexpr unsigned kUsual = 8;
  const char* const asked = std::getenv("TAGFIELD_SURVEYS");
  return asked == nullptr ? kUsual : static_cast<unsigned>(std::max(1, std::atoi(asked)));
}

Claims random_claims(const std::string& method, bool with_strays) {
  Claims claims;
  for (unsigned seed = 1; seed <= count_of_surveys(); ++seed) {
    Rng rng(seed);
    const SurveyPlan plan = any_plan(with_strays, rng);
    Survey survey = make_survey(plan, rng);
    survey.known.pi_ambiguity = plan.pi_ambiguity;
    add_claims(method, survey, claims);
  }
  return claims;
}

class RandomSurveys : public testing::TestWithParam<std::string> {};

TEST_P(RandomSurveys, FewClaimsAreFalse) {
  for (const bool with_strays : {false, true}) {
    const Claims claims = random_claims(GetParam(), with_strays);
    fmt::print(
        "{}{}: {} tags, {} located, {} of them falsely; error/expected {:.2f}, at most {:.1f}\n",
        GetParam(), with_strays ? " with stray phases" : "", claims.tags, claims.located,
        claims.false_ones, claims.calibration(), claims.worst);
    EXPECT_GE(3 * claims.located, claims.tags);
    EXPECT_LE(claims.false_ones, 1 + claims.located / 50);
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, RandomSurveys,
                         testing::Values("auto", "hyperbola", "least_squares", "ml", "joint", "sar",
                                         "robust", "dah", "particle"),
                         [](const auto& method) { return method.param; });

}  // namespace
}  // namespace tagfield::made
