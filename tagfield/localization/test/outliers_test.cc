// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

using made::Rng;

Eigen::ArrayXd angles(int count, double sigma, double share, Rng& rng) {
  Eigen::ArrayXd of(count);
  for (double& angle : of) {
    const bool is_outlier = made::uniform(rng, 0.0, 1.0) < share;
    angle = is_outlier ? made::uniform(rng, -kPi, kPi) : made::normal(rng, sigma);
  }
  return of;
}

TEST(Outliers, MixtureFindsNoiseAndShare) {
  Rng rng(1);
  const OutlierMixture mixture = outlier_mixture(angles(20000, 0.1, 0.05, rng));
  EXPECT_NEAR(mixture.sigma_rad, 0.1, 0.003);
  EXPECT_NEAR(mixture.share, 0.05, 0.006);
  EXPECT_TRUE(has_outliers(mixture));
}

// Bayes' theorem for normal noise and uniformly distributed angles.
TEST(Outliers, EachIsOneByTheDensities) {
  Rng rng(4);
  const Eigen::ArrayXd drawn = angles(2000, 0.2, 0.1, rng);
  const OutlierMixture mixture = outlier_mixture(drawn);
  for (Eigen::Index i = 0; i < drawn.size(); ++i) {
    const double z = drawn[i] / mixture.sigma_rad;
    const double noise =
        (1.0 - mixture.share) / (mixture.sigma_rad * std::sqrt(kTwoPi)) * std::exp(-0.5 * z * z);
    const double other = mixture.share / kTwoPi;
    ASSERT_NEAR(mixture.probability[i], other / (noise + other), 1e-4) << drawn[i];
  }
}

TEST(Outliers, AreNotClaimedOfNoiseAlone) {
  Rng rng(2);
  int claims = 0;
  for (int i = 0; i < 1000; ++i) {
    claims += has_outliers(outlier_mixture(angles(200, 0.3, 0.0, rng))) ? 1 : 0;
  }
  EXPECT_LE(claims, 10);
}

// Arbitrary phases come at random; what a pose error or a wrong position leaves comes in a row.
TEST(Outliers, InARowAreNone) {
  Rng rng(5);
  TagPhases phases;
  constexpr int kReads = 1000;
  phases.spans.resize(2);
  phases.spans[0].count = phases.spans[1].begin = phases.spans[1].count = kReads / 2;
  int scattered = 0;
  int in_a_row = 0;
  for (int i = 0; i < 200; ++i) {
    const double share = made::uniform(rng, 0.01, 0.2);
    Eigen::ArrayXd at_random(kReads);
    for (double& p : at_random) p = made::uniform(rng, 0.0, 1.0) < share ? 0.9 : 0.1;
    Eigen::ArrayXd row = Eigen::ArrayXd::Constant(kReads, 0.1);
    row.segment(100, static_cast<Eigen::Index>(share * kReads)) = 0.9;
    scattered += are_scattered(phases, at_random) ? 1 : 0;
    in_a_row += are_scattered(phases, row) ? 1 : 0;
  }
  // Three standard deviations: 99.9 % of 200 are within.
  EXPECT_GE(scattered, 197);
  EXPECT_EQ(in_a_row, 0);
}

TEST(Outliers, AreTakenOutAndOthersLeft) {
  Rng rng(3);
  const made::Path path = made::s_curve(10.0, 0.02);
  made::Hall hall = made::hall(path, path, 1, {}, rng);
  SamplesOfTag& samples = hall.problem.samples["t0"];
  const std::size_t before = samples["a"].size();
  std::size_t spoilt = 0;
  for (PhaseSample& sample : samples["a"]) {
    if (made::uniform(rng, 0.0, 1.0) > 0.05) continue;
    sample.phase_rad = made::uniform(rng, 0.0, kTwoPi);
    ++spoilt;
  }
  const std::size_t removed = remove_outliers(hall.problem, "t0", samples);
  EXPECT_EQ(samples["a"].size() + removed, before);
  // One in ten random phases is within 0.3 rad of the right one.
  EXPECT_GT(static_cast<double>(removed), 0.75 * static_cast<double>(spoilt));
  EXPECT_LT(static_cast<double>(removed), 1.2 * static_cast<double>(spoilt));
}

TEST(Outliers, StrayPhasesAreBackAfterwards) {
  Rng rng(5);
  const made::Path path = made::s_curve(12.0, 0.02);
  made::Hall hall = made::hall(path, path, 6, {}, rng);
  std::size_t spoilt = 0;
  for (auto& [tag, samples] : hall.problem.samples) {
    for (std::size_t i = 0; i < samples["a"].size(); ++i) {
      const bool is_end = i == 0 || i + 1 == samples["a"].size();
      if (!is_end && made::uniform(rng, 0.0, 1.0) > 0.02) continue;
      samples["a"][i].phase_rad = wrap_to_two_pi(samples["a"][i].phase_rad + 2.5);
      ++spoilt;
    }
  }
  const SamplesByTag before = hall.problem.samples;
  Diagnostics diagnostics;
  {
    const WithoutStrayPhases cleaned(hall.problem, 2, diagnostics);
    std::size_t out = 0;
    for (const auto& [tag, samples] : hall.problem.samples) {
      out += before.at(tag).at("a").size() - samples.at("a").size();
    }
    EXPECT_GT(static_cast<double>(out), 0.75 * static_cast<double>(spoilt));
    EXPECT_LT(static_cast<double>(out), 1.5 * static_cast<double>(spoilt));
    EXPECT_EQ(diagnostics.warnings().size(), 1U);
  }
  const auto is_equal = [](const PhaseSample& one, const PhaseSample& other) {
    return one.stamp == other.stamp && one.phase_rad == other.phase_rad;
  };
  for (const auto& [tag, samples] : before) {
    const std::vector<PhaseSample>& after = hall.problem.samples.at(tag).at("a");
    EXPECT_TRUE(std::equal(after.begin(), after.end(), samples.at("a").begin(),
                           samples.at("a").end(), is_equal))
        << tag;
  }
}

/// With one in 20 phases random, `auto` has the same errors as without them.
TEST(Outliers, DoNotHurtTheAutomaticChoice) {
  Rng rng(4);
  const made::Path path = made::s_curve(12.0, 0.02);
  made::Hall hall = made::hall(path, path, 12, {}, rng);
  double errors[2] = {0.0, 0.0};
  for (const int spoilt : {0, 1}) {
    for (auto& [tag, samples] : hall.problem.samples) {
      for (PhaseSample& sample : samples["a"]) {
        if (spoilt == 1 && made::uniform(rng, 0.0, 1.0) < 0.05) {
          sample.phase_rad = made::uniform(rng, 0.0, kTwoPi);
        }
      }
    }
    Diagnostics diagnostics;
    const auto result =
        find_method(built_in_methods(), "auto").locate(hall.problem, 2, diagnostics);
    for (const TagEstimate& estimate : result.estimates) {
      ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
      errors[spoilt] += (estimate.candidates.front().p_WT - hall.truth[estimate.tag]).norm() / 12.0;
    }
  }
  EXPECT_LT(errors[1], 1.5 * errors[0] + 1e-3);
}

}  // namespace
}  // namespace tagfield
