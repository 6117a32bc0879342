// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/coherent_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>

#include "method_study.h"

namespace tagfield {
namespace {

using namespace made;

/// Concentration of von Mises noise whose mean cosine, I₁(κ)/I₀(κ), is `share`.
double von_mises_concentration(double share) {
  double low = 0.0;
  double high = 50.0;
  for (int i = 0; i < 60; ++i) {
    const double half = 0.5 * (low + high);
    (std::cyl_bessel_i(1.0, half) < share * std::cyl_bessel_i(0.0, half) ? low : high) = half;
  }
  return low;
}

/// |S| computed directly with complex numbers.
double waves_at(const std::vector<PhaseSample>& samples, const Eigen::Vector3d& p_WT) {
  std::complex<double> sum = 0.0;
  for (const PhaseSample& s : samples) {
    const double k = 2.0 * kTwoPi / wavelength(s.frequency_hz);
    sum += std::polar(1.0, s.phase_rad - k * (p_WT - s.p_WA).norm());
  }
  return std::abs(sum);
}

/// A hundred reads along a third of a circle, with phase errors of alternately ±1.1 rad, so that 45
/// % of the phasors add up. Positions further away are less likely, by κ ΔS, as the reads are
/// independent.
TEST(CoherentFit, NoisyTagsHaveTheOtherPlacesThatAreAsLikelyButForE4) {
  constexpr int kReads = 100;
  const double noise_rad = std::acos(0.45);
  const Eigen::Vector3d p_WT(3.0, 0.0, 0.4);
  std::vector<PhaseSample> samples;
  for (int i = 0; i < kReads; ++i) {
    const double angle = kTwoPi / 3.0 * ((i + 0.5) / kReads - 0.5);
    const Eigen::Vector3d p_WA(std::cos(angle), std::sin(angle), 0.4);
    const double k = 2.0 * kTwoPi / wavelength(865.7e6);
    const double phase = k * (p_WT - p_WA).norm() + (i % 2 == 0 ? noise_rad : -noise_rad);
    samples.push_back({time_from_seconds(0.1 * i), wrap_to_two_pi(phase), 865.7e6, p_WA});
  }
  const Eigen::Vector3d likely = p_WT + Eigen::Vector3d(0.5, 0.0, 0.0);
  const Eigen::Vector3d unlikely = p_WT + Eigen::Vector3d(1.0, 0.0, 0.0);
  const double kappa = von_mises_concentration(0.45);
  const double best = waves_at(samples, p_WT);
  ASSERT_NEAR(best, 0.45 * kReads, 1e-9);
  ASSERT_LT(kappa * (best - waves_at(samples, likely)), 3.0);
  ASSERT_GT(kappa * (best - waves_at(samples, unlikely)), 5.0);
  const LocalizationProblem problem = one_tag({{"a", samples}}, p_WT.z());
  const TagPhases phases = coherent_reads(problem, problem.samples.at("t"));
  const HeightModel height = height_model(problem, "t", phases);
  CoherentJudgement judgement;
  judgement.climb = false;
  std::vector<PositionVector> places;
  for (const Eigen::Vector3d& place : {unlikely, p_WT, likely}) {
    places.push_back(to_unknowns(height, place));
  }
  EstimateLimits any;
  any.max_expected_error_m = any.max_rms_m = 1e3;
  const TagEstimate estimate = judge_places(phases, height, places, judgement, any, {});
  EXPECT_EQ(estimate.verdict, Verdict::kAmbiguous) << estimate.reason;
  ASSERT_EQ(estimate.candidates.size(), 2U);
  EXPECT_LT(level_error(estimate.candidates[0], p_WT), 1e-9);
  EXPECT_LT(level_error(estimate.candidates[1], likely), 1e-9);
}

}  // namespace
}  // namespace tagfield
