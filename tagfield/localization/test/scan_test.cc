// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/scan/scan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "tagfield/base/error.h"
#include "tagfield/localization/scan/pooled_distance.h"
#include "tagfield/localization/scan/scan_field.h"
#include "tagfield/localization/scan/two_paths.h"
#include "tagfield/localization/test/made_reads.h"

namespace tagfield {
namespace {

using made::Rng;

constexpr double kCarrier = 866e6;
constexpr double kRail = 0.3;  ///< Height of the rail [m].

struct Echo {
  Eigen::Vector2d place;
  double strength = 0.0;  ///< Relative to the direct path.
};

/// One-way field at `p` of the tag and its echo, in the plane.
std::complex<double> field_at(const Eigen::Vector2d& p, const Eigen::Vector2d& tag,
                              const Echo& echo) {
  const double k = kTwoPi / wavelength(kCarrier);
  const auto wave = [&](const Eigen::Vector2d& from, double strength) {
    const double r = (p - from).norm();
    return std::polar(strength * std::abs(from.y()) / (r * r), k * r);
  };
  return wave(tag, 1.0) + wave(echo.place, echo.strength);
}

/// Reads on a rail of 1 m along x with 50 stops, with both paths there and back.
SamplesOfTag scanned(const Eigen::Vector2d& tag, const Echo& echo, double noise_rad, Rng& rng) {
  SamplesOfTag samples;
  const double offset = made::uniform(rng, 0.0, kTwoPi);
  for (int i = 0; i < 50; ++i) {
    const Eigen::Vector2d p(0.02 * i, 0.0);
    const std::complex<double> there_and_back = std::pow(field_at(p, tag, echo), 2);
    const double phase = std::arg(there_and_back) + offset + made::normal(rng, noise_rad);
    samples["a"].push_back({time_from_seconds(i),
                            wrap_to_two_pi(phase),
                            kCarrier,
                            {p.x(), p.y(), kRail},
                            20.0 * std::log10(std::abs(there_and_back))});
  }
  return samples;
}

LocalizationProblem problem_of(const std::vector<Eigen::Vector2d>& tags, double echo_strength,
                               Rng& rng) {
  LocalizationProblem problem;
  for (std::size_t i = 0; i < tags.size(); ++i) {
    const Echo echo{{made::uniform(rng, -0.5, 1.5), made::uniform(rng, 0.5, 2.5)}, echo_strength};
    problem.samples["t" + std::to_string(i)] = scanned(tags[i], echo, 0.03, rng);
  }
  problem.area.side = TagSide::kPlusY;
  return problem;
}

std::vector<TagEstimate> estimates_of(const LocalizationProblem& problem) {
  Diagnostics diagnostics;
  return scan_method().locate(problem, 2, diagnostics).estimates;
}

double distance_to(const TagEstimate& estimate, const Eigen::Vector2d& truth) {
  return (estimate.candidates.front().p_WT.head<2>() - truth).norm();
}

TEST(ScanField, IsTheRootOfWhatIsRead) {
  Rng rng(1);
  const Eigen::Vector2d tag(0.4, 0.7);
  LocalizationProblem problem;
  problem.samples["t"] = scanned(tag, {{1.0, 1.0}, 0.3}, 0.0, rng);
  const ScanField scan = scan_field(problem, "t", problem.samples["t"]);
  ASSERT_EQ(scan.why_not, "");
  ASSERT_EQ(scan.field.size(), 50);
  // Equal up to a complex factor.
  std::complex<double> match = 0.0;
  double power = 0.0;
  for (Eigen::Index i = 0; i < 50; ++i) {
    const std::complex<double> field =
        field_at({0.02 * static_cast<double>(i), 0.0}, tag, {{1.0, 1.0}, 0.3});
    match += std::conj(field) * scan.field[i];
    power += std::norm(field);
  }
  EXPECT_NEAR(std::norm(match) / power, 1.0, 1e-6);
  // 1 m of path, over which the field changes within λ/2: about 2 L/λ + 1.
  EXPECT_NEAR(scan.samples, 6.6, 0.5);
}

TEST(ScanField, IsThatOfTheAntennaWithMostPlacesWhateverOthersStoodStill) {
  Rng rng(1);
  const Eigen::Vector2d tag(0.4, 0.7);
  const std::vector<PhaseSample> all = scanned(tag, {{1.0, 1.0}, 0.0}, 0.0, rng).at("a");
  std::vector<PhaseSample> still = all;
  for (PhaseSample& sample : still) sample.p_WA = {2.0, 2.0, kRail};
  // In order of names: one covers half of the rail, one is stationary, and one covers all of it.
  const SamplesOfTag samples{{"a", {all.begin(), all.begin() + 25}}, {"b", still}, {"c", all}};
  const ScanField scan = scan_field({}, "t", samples);
  ASSERT_EQ(scan.why_not, "");
  EXPECT_EQ(scan.field.size(), 50);
  EXPECT_NEAR(scan.end_m - scan.begin_m, 0.98, 1e-9);
}

TEST(ScanField, IsThatOfTheLongestSectionWithoutAGap) {
  // A gap of 12 cm, over λ/4 = 8.7 cm; one of 8 cm is none.
  Rng rng(1);
  const std::vector<PhaseSample> all = scanned({0.4, 0.7}, {{1.0, 1.0}, 0.3}, 0.0, rng).at("a");
  for (const auto& [missing, left, end_m] : {std::tuple(5, 30, 0.58), std::tuple(3, 47, 0.98)}) {
    std::vector<PhaseSample> some = all;
    some.erase(some.begin() + 30, some.begin() + 30 + missing);
    const ScanField scan = scan_field({}, "t", {{"a", some}});
    ASSERT_EQ(scan.why_not, "");
    EXPECT_EQ(scan.field.size(), left);
    EXPECT_NEAR(scan.end_m - scan.begin_m, end_m, 1e-9);
  }
}

TEST(ScanField, SaysWhyThereIsNone) {
  Rng rng(1);
  LocalizationProblem problem;
  SamplesOfTag bent = scanned({0.4, 0.7}, {{1.0, 1.0}, 0.0}, 0.0, rng);
  for (PhaseSample& sample : bent["a"]) sample.p_WA.y() = 0.3 * std::sin(3.0 * sample.p_WA.x());
  EXPECT_NE(scan_field(problem, "t", bent).why_not.find("not straight"), std::string::npos);
}

TEST(PooledDistance, TagsAtOneDistanceHelpEachOther) {
  const Eigen::ArrayXd away = Eigen::ArrayXd::LinSpaced(100, std::log(0.1), std::log(4.0)).exp();
  const auto about = [&](double middle, double spread) -> Eigen::ArrayXd {
    return (-0.5 * ((away / middle).log() / spread).square()).exp();
  };
  // Nine sharp ones at 0.8 m, and one that carries hardly any information.
  std::vector<Eigen::ArrayXd> likelihoods(9, about(0.8, 0.05));
  likelihoods.push_back(about(1.5, 1.0));
  const Eigen::ArrayXd expected = expected_distances(away, likelihoods).back();
  const Eigen::ArrayXd posterior = expected * likelihoods.back();
  Eigen::Index best = 0;
  posterior.maxCoeff(&best);
  EXPECT_NEAR(away[best], 0.8, 0.05);
  // If distances differ by factors, nothing is learned: the expectation is wide.
  std::vector<Eigen::ArrayXd> apart;
  for (const double middle : {0.3, 0.6, 1.2, 2.4}) apart.push_back(about(middle, 0.05));
  apart.push_back(about(1.5, 1.0));
  const Eigen::ArrayXd wide = expected_distances(away, apart).back();
  EXPECT_GT(wide.maxCoeff() / wide.mean(), 1.0);
  EXPECT_LT(wide.maxCoeff() / wide.mean(), 4.0);
  EXPECT_GT(expected.maxCoeff() / expected.mean(), 8.0);
}

TEST(Scan, LocatesAmidEchoesAndKnowsHowWell) {
  Rng rng(7);
  double ratios = 0.0;
  double errors = 0.0;
  int located = 0;
  constexpr int kTags = 24;
  for (int run = 0; run < kTags / 4; ++run) {
    std::vector<Eigen::Vector2d> tags;
    for (int i = 0; i < 4; ++i) {
      tags.push_back({made::uniform(rng, 0.1, 0.9), made::uniform(rng, 0.5, 0.9)});
    }
    const auto estimates = estimates_of(problem_of(tags, 0.35, rng));
    for (std::size_t i = 0; i < tags.size(); ++i) {
      if (estimates[i].verdict != Verdict::kLocated) continue;
      ++located;
      const double error = distance_to(estimates[i], tags[i]);
      errors += error;
      ratios += std::pow(error / estimates[i].candidates.front().expected_error_m, 2);
    }
  }
  EXPECT_GE(located, 0.95 * kTags);
  EXPECT_LT(errors / located, 0.1);
  EXPECT_LT(std::sqrt(ratios / located), 1.5);
}

TEST(Scan, WithoutASideBothAreNamed) {
  Rng rng(3);
  const Eigen::Vector2d tag(0.4, 0.7);
  LocalizationProblem problem = problem_of({tag}, 0.2, rng);
  problem.area = {};
  const TagEstimate estimate = estimates_of(problem).front();
  EXPECT_EQ(estimate.verdict, Verdict::kAmbiguous);
  ASSERT_EQ(estimate.candidates.size(), 2U);
  EXPECT_NEAR(estimate.candidates[0].p_WT.y(), -estimate.candidates[1].p_WT.y(), 1e-9);
  EXPECT_NEAR(estimate.candidates[0].p_WT.z(), kRail, 1e-9);
}

TEST(Scan, OnlyARangeOfOverHalfAMetreIsOne) {
  ScanOptions options;
  options.max_range_m = 0.5;
  EXPECT_THROW(scan_method(options), Error);
  options.max_range_m = 0.55;
  Rng rng(3);
  LocalizationProblem problem = problem_of({{0.4, 0.4}}, 0.0, rng);
  Diagnostics diagnostics;
  const TagEstimate near = scan_method(options).locate(problem, 1, diagnostics).estimates.front();
  ASSERT_EQ(near.verdict, Verdict::kLocated) << near.reason;
  EXPECT_LT(distance_to(near, {0.4, 0.4}), 0.05);
}

TEST(Scan, NothingOfRandomPhases) {
  Rng rng(5);
  constexpr int kTags = 60;
  int claims = 0;
  LocalizationProblem problem =
      problem_of(std::vector<Eigen::Vector2d>(kTags, {0.5, 0.7}), 0.0, rng);
  for (auto& [tag, samples] : problem.samples) {
    for (PhaseSample& sample : samples["a"]) sample.phase_rad = made::uniform(rng, 0.0, kTwoPi);
  }
  for (const TagEstimate& estimate : estimates_of(problem)) {
    claims += estimate.verdict == Verdict::kNotLocated ? 0 : 1;
  }
  EXPECT_EQ(claims, 0);
}

}  // namespace
}  // namespace tagfield
