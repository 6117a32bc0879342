// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/plausibility.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>

#include "method_study.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

using made::Rng;

/// Σ|S_g| of random phasors.
double random_sum(const std::vector<double>& reads, Rng& rng) {
  double sum = 0.0;
  for (const double n : reads) {
    std::complex<double> waves = 0.0;
    for (int i = 0; i < static_cast<int>(n); ++i) {
      waves += std::polar(1.0, made::uniform(rng, 0.0, kTwoPi));
    }
    sum += std::abs(waves);
  }
  return sum;
}

TEST(Plausibility, ChanceIsBoundedFromAbove) {
  Rng rng(1);
  constexpr int kDraws = 20000;
  for (const std::vector<double>& reads :
       {std::vector<double>{100.0}, std::vector<double>(50, 7.0), std::vector<double>(30, 1.0)}) {
    int beyond = 0;
    for (int i = 0; i < kDraws; ++i) {
      beyond += log_chance(reads, random_sum(reads, rng), 1.0) < std::log(0.05) ? 1 : 0;
    }
    EXPECT_LE(beyond, 0.05 * kDraws) << reads.size();
  }
}

TEST(Plausibility, ChanceOfPairsIsBoundedFromAbove) {
  Rng rng(8);
  constexpr int kDraws = 1000;
  const std::vector<double> pairs(40, 2.0);
  int beyond = 0;
  for (int i = 0; i < kDraws; ++i) {
    beyond += log_chance(pairs, random_sum(pairs, rng), 1.0) < std::log(0.05) ? 1 : 0;
  }
  EXPECT_LE(beyond, 0.05 * kDraws);
}

/// E e^(λ|S|) of two random phasors, |S| = 2|cos(θ/2)|, as a sum over a period.
double mean_of_pair(double lambda) {
  constexpr int kSteps = 2000;
  double sum = 0.0;
  for (int i = 0; i < kSteps; ++i) {
    sum += std::exp(2.0 * lambda * std::abs(std::cos(0.5 * kTwoPi * i / kSteps)));
  }
  return sum / kSteps;
}

TEST(Plausibility, ChanceOfPairsIsChernoffsBound) {
  constexpr double kPairs = 40.0;
  // The mean sum is 40·4/π = 51.
  for (const double sum : {56.0, 62.0, 68.0, 74.0}) {
    double least = 0.0;
    for (double lambda = 0.01; lambda < 20.0; lambda *= 1.01) {
      least = std::min(least, kPairs * std::log(mean_of_pair(lambda)) - lambda * sum);
    }
    const double found = log_chance(std::vector<double>(40, 2.0), sum, 1.0);
    // Any λ gives a bound; that of a coarser search is a little above the least.
    EXPECT_GE(found, least - 1e-3) << sum;
    EXPECT_LE(found, 0.95 * least) << sum;
  }
}

TEST(Plausibility, FreeOffsetsCount) {
  // With one read per aperture all phasors add up, whatever their phases.
  EXPECT_GE(log_chance(std::vector<double>(100, 1.0), 100.0, 1.0), 0.0);
  // A larger sum is impossible.
  EXPECT_LT(log_chance(std::vector<double>(4, 1.0), 4.2, 1.0), std::log(1e-3));
  // For a single aperture the same sum is not due to chance.
  EXPECT_LT(log_chance({100.0}, 100.0, 1e6), std::log(1e-20));
}

TEST(Plausibility, NoMethodPlacesRandomPhases) {
  Rng rng(2);
  const made::Path path = made::s_curve(6.0, 0.02);
  made::Hall hall = made::hall(path, path, 40, {}, rng);
  for (auto& [tag, samples] : hall.problem.samples) {
    int i = 0;
    for (PhaseSample& sample : samples["a"]) {
      sample.phase_rad = made::uniform(rng, 0.0, kTwoPi);
      sample.frequency_hz = 902.75e6 + 0.5e6 * (++i / 6 % 50);
    }
  }
  for (const char* name : {"hyperbola", "ml", "sar"}) {
    Diagnostics diagnostics;
    LocalizationResult result =
        find_method(built_in_methods(), name).locate(hall.problem, 2, diagnostics);
    refuse_chance(hall.problem, result);
    for (const TagEstimate& estimate : result.estimates) {
      EXPECT_EQ(estimate.verdict, Verdict::kNotLocated) << name << " " << estimate.tag;
    }
  }
}

/// Thirty-one reads whose phasors all add up; the number of positions in reach limits what chance
/// can do.
TEST(Plausibility, WhereTheWorldHasItsOriginDoesNotMatter) {
  Rng rng(7);
  for (const double east_m : {0.0, 5e4, -5e4}) {
    const Eigen::Vector3d east(east_m, 0.0, 0.0);
    made::Path path = made::straight(0.6, 0.02);
    for (Eigen::Vector3d& p_WA : path) p_WA += east;
    const Eigen::Vector3d tag = east + Eigen::Vector3d(0.2, 1.0, 0.4);
    LocalizationProblem problem;
    problem.samples["t"]["a"] = made::read_along(path, path, tag, {0.0, 0.0}, rng);
    LocalizationResult result;
    result.estimates = {{"t", Verdict::kLocated, "", {{tag, 0.0, 0.01}}, path.size()}};
    refuse_chance(problem, result);
    EXPECT_EQ(result.estimates.front().verdict, Verdict::kLocated) << east_m;
  }
}

TEST(Plausibility, TwoTagsUnderOneNameAreNone) {
  Rng rng(4);
  const made::Path path = made::s_curve(8.0, 0.02);
  made::Hall hall = made::hall(path, path, 12, {}, rng);
  for (int i = 0; i < 12; i += 2) {
    auto& mixed = hall.problem.samples["t" + std::to_string(i)]["a"];
    for (const PhaseSample& of_other : hall.problem.samples["t" + std::to_string(i + 1)]["a"]) {
      for (PhaseSample& sample : mixed) {
        if (sample.stamp == of_other.stamp && made::uniform(rng, 0.0, 1.0) < 0.5) sample = of_other;
      }
    }
    hall.problem.samples.erase("t" + std::to_string(i + 1));
  }
  Diagnostics diagnostics;
  LocalizationResult result =
      find_method(built_in_methods(), "sar").locate(hall.problem, 2, diagnostics);
  refuse_mixtures(hall.problem, result);
  for (const TagEstimate& estimate : result.estimates) {
    EXPECT_NE(estimate.verdict, Verdict::kLocated) << estimate.tag;
  }
}

TEST(Plausibility, ATagOnAStraightWaysLineMayBeOnEitherSide) {
  Rng rng(5);
  const made::Path path = made::straight(6.0, 0.02);
  LocalizationProblem problem;
  const Eigen::Vector3d tag(3.0, 0.012, 0.4);
  problem.samples["t"]["a"] = made::read_along(path, tag, {}, rng);
  problem.pose_error = PoseErrorModel{};
  Diagnostics diagnostics;
  LocalizationResult result = find_method(built_in_methods(), "ml").locate(problem, 1, diagnostics);
  span_line(problem, result);
  TagEstimate& estimate = result.estimates.front();
  if (estimate.verdict != Verdict::kLocated) return;
  const double error = (estimate.candidates.front().p_WT - tag).norm();
  EXPECT_LT(error, 5.0 * estimate.candidates.front().expected_error_m);
  EXPECT_GT(estimate.candidates.front().expected_error_m, 0.01);
}

/// Beside a straight path the mirror image fits as well: of two equal and narrow peaks at ±d the
/// mean square deviation from one is ½ (2d)².
TEST(Plausibility, TheMirrorImageBesideAStraightPathIsPartOfTheError) {
  Rng rng(7);
  const double d = 0.3;
  const Eigen::Vector3d tag(3.0, d, 0.4);
  LocalizationProblem problem =
      made::one_tag({{"a", made::read_along(made::straight(6.0, 0.02), tag, {}, rng)}}, 0.4);
  problem.limits.max_expected_error_m = 10.0;
  Candidate candidate;
  candidate.p_WT = tag;
  candidate.expected_error_m = 0.001;
  candidate.covariance = Eigen::Matrix3d::Zero();
  LocalizationResult result;
  result.estimates.resize(1);
  result.estimates[0].tag = "t";
  result.estimates[0].verdict = Verdict::kLocated;
  result.estimates[0].candidates = {candidate};
  span_line(problem, result);
  const Eigen::Matrix3d covariance = result.estimates[0].candidates.at(0).covariance.value();
  EXPECT_NEAR(covariance(1, 1) / (2.0 * d * d), 1.0, 0.1);
  EXPECT_LT(covariance(0, 0), 1e-4);
}

TEST(Plausibility, AheadOfAStraightWayThereAreManyPlaces) {
  Rng rng(6);
  const made::Path path = made::straight(6.0, 0.02);
  const auto is_false = [](const TagEstimate& estimate, const Eigen::Vector3d& tag) {
    if (estimate.verdict != Verdict::kLocated) return false;
    const Candidate& best = estimate.candidates.front();
    return (best.p_WT - tag).norm() > 5.0 * best.expected_error_m;
  };
  int before = 0;
  for (int i = 0; i < 200; ++i) {
    LocalizationProblem problem;
    const Eigen::Vector3d tag{made::uniform(rng, 6.1, 7.0), made::normal(rng, 0.03), 0.4};
    problem.samples["t"]["a"] = made::read_along(path, tag, {}, rng);
    problem.heights.of_all = 0.4;
    Diagnostics diagnostics;
    LocalizationResult result =
        find_method(built_in_methods(), "ml").locate(problem, 1, diagnostics);
    before += is_false(result.estimates.front(), tag) ? 1 : 0;
    span_line(problem, result);
    EXPECT_FALSE(is_false(result.estimates.front(), tag)) << i;
  }
  EXPECT_GT(before, 0);  // Otherwise the test shows nothing.
}

TEST(Plausibility, SaysThatTheSignIsWrong) {
  Rng rng(3);
  const made::Path path = made::s_curve(8.0, 0.02);
  made::Hall hall = made::hall(path, path, 6, {}, rng);
  for (const bool turned : {false, true}) {
    if (turned) {
      for (auto& [tag, samples] : hall.problem.samples) {
        for (PhaseSample& sample : samples["a"]) sample.phase_rad = kTwoPi - sample.phase_rad;
      }
    }
    Diagnostics diagnostics;
    LocalizationResult result =
        find_method(built_in_methods(), "sar").locate(hall.problem, 2, diagnostics);
    refuse_wrong_sign(hall.problem, result, diagnostics);
    EXPECT_EQ(diagnostics.warnings().size(), turned ? 1U : 0U);
    for (const TagEstimate& estimate : result.estimates) {
      EXPECT_EQ(estimate.verdict == Verdict::kLocated, !turned) << estimate.reason;
    }
  }
}

}  // namespace
}  // namespace tagfield
