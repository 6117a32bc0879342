// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/rssi_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "method_study.h"
#include "tagfield/localization/signal_strength/rssi_search.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield {
namespace {

using namespace made;

/// A gain [dB] that is a polynomial of the second degree in the direction.
double quadratic_gain(const Eigen::Vector3d& u) {
  return 3.0 * u.x() - 2.0 * u.y() + 4.0 * u.x() * u.y() + 2.5 * u.x() * u.x() - u.y() * u.z();
}

/// A tag read by an antenna that turns as it goes along a curve.
LocalizationProblem directed_problem(const Eigen::Vector3d& p_WT, double slope_db, double noise_db,
                                     Rng& rng) {
  LocalizationProblem problem = one_tag({}, p_WT.z());
  const Path path = s_curve(12.0, 0.1);
  for (std::size_t i = 0; i < path.size(); ++i) {
    const Eigen::Quaterniond rotation(
        Eigen::AngleAxisd(0.05 * static_cast<double>(i), Eigen::Vector3d::UnitZ()));
    PhaseSample sample;
    sample.stamp = time_from_seconds(static_cast<double>(i));
    sample.frequency_hz = 865.7e6;
    sample.p_WA = path[i];
    const Eigen::Vector3d u_W = (p_WT - path[i]).normalized();
    sample.rssi_dbm = -30.0 - slope_db * std::log10((p_WT - path[i]).norm()) + quadratic_gain(u_W) +
                      quadratic_gain(rotation.conjugate() * u_W) + normal(rng, noise_db);
    problem.tracks["a"].X_WA.push_back({sample.stamp, {rotation, path[i]}});
    problem.samples["t"]["a"].push_back(sample);
  }
  return problem;
}

BinnedRssi bins_of(const LocalizationProblem& problem, const Lobe& lobe = {}) {
  return binned_rssi(problem, problem.samples.at("t"), 0.01, lobe);
}

TEST(RssiFit, GainsOfTheSecondDegreeAreExplained) {
  Rng rng(1);
  const Eigen::Vector3d p_WT(4.0, 2.5, 1.1);
  const BinnedRssi bins = bins_of(directed_problem(p_WT, 35.0, 0.0, rng));
  PathLossLaw law;
  law.slope_db = 35.0;
  EXPECT_GT(misfit_at(bins, law, p_WT).residuals.abs().maxCoeff(), 1.0);
  law.pattern_sigma_db = 1e4;
  EXPECT_LT(misfit_at(bins, law, p_WT).residuals.abs().maxCoeff(), 1e-4);
}

/// With a half-power width of 90° each way has a gain of cos² of the angle off boresight.
TEST(RssiFit, AStatedLobeIsExplained) {
  constexpr double kFrontToBack_dB = 6.0;
  Rng rng(6);
  const Eigen::Vector3d p_WT(4.0, 2.5, 1.1);
  LocalizationProblem problem = directed_problem(p_WT, 35.0, 0.0, rng);
  const auto& poses = problem.tracks.at("a").X_WA;
  std::size_t clipped = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const Eigen::Vector3d p_AT = poses[i].X_WB.inverse() * p_WT;
    const double cosine = p_AT.x() / p_AT.norm();
    const double least = -2.0 * kFrontToBack_dB;
    const double gain = cosine > 0.0 ? std::max(40.0 * std::log10(cosine), least) : least;
    if (gain == least) ++clipped;
    problem.samples["t"]["a"][i].rssi_dbm = -30.0 - 35.0 * std::log10(p_AT.norm()) + gain;
  }
  ASSERT_GT(clipped, poses.size() / 4);
  Lobe lobe;
  lobe.beam_width_deg = 90.0;
  lobe.front_to_back_db = kFrontToBack_dB;
  PathLossLaw law;
  law.slope_db = 35.0;
  EXPECT_GT(misfit_at(bins_of(problem), law, p_WT).residuals.abs().maxCoeff(), 3.0);
  EXPECT_LT(misfit_at(bins_of(problem, lobe), law, p_WT).residuals.abs().maxCoeff(), 1e-9);
}

/// The parabola's cost is that of a fit with each slope, whatever else the law says.
TEST(RssiFit, AParabolaGivesTheCostForEachSlope) {
  Rng rng(2);
  const BinnedRssi bins = bins_of(directed_problem({4.0, 2.5, 1.1}, 40.0, 2.0, rng));
  for (const double pattern_sigma_db : {0.0, 0.5, 5.0}) {
    for (const bool is_level_known : {false, true}) {
      PathLossLaw law;
      law.pattern_sigma_db = pattern_sigma_db;
      if (is_level_known) law.levels["a"] = {-32.0, 1.5};
      const Eigen::Vector3d p_WT(uniform(rng, 1.0, 6.0), uniform(rng, 1.0, 4.0), 1.1);
      const RssiCell cell{p_WT, parabola_at(bins, law, p_WT), {}};
      for (const double slope_db : {20.0, 33.0, 55.0}) {
        law.slope_db = slope_db;
        const RssiMisfit misfit = misfit_at(bins, law, p_WT);
        EXPECT_NEAR(cost_of(cell, slope_db) / misfit.cost, 1.0, 1e-9);
        EXPECT_NEAR(cell.cost.log_determinant, misfit.log_determinant, 1e-9);
      }
    }
  }
}

/// The gradient is that of half the cost, by differences; lobes included.
TEST(RssiFit, TheGradientIsThatOfTheCost) {
  Rng rng(3);
  const LocalizationProblem problem = directed_problem({4.0, 2.5, 1.1}, 40.0, 2.0, rng);
  Lobe lobe;
  lobe.beam_width_deg = 120.0;
  lobe.front_to_back_db = 200.0;  // No edge at which the lobe ends.
  for (const BinnedRssi& bins : {bins_of(problem), bins_of(problem, lobe)}) {
    for (const double pattern_sigma_db : {0.0, 3.0}) {
      PathLossLaw law;
      law.pattern_sigma_db = pattern_sigma_db;
      const Eigen::Vector3d p_WT(3.3, 3.1, 1.1);
      const auto cost_at = [&](double x, double y) {
        return 0.5 * misfit_at(bins, law, p_WT + Eigen::Vector3d(x, y, 0.0)).cost;
      };
      constexpr double kStep = 1e-5;
      const RssiNormal normal = normal_at(bins, law, p_WT, misfit_at(bins, law, p_WT));
      const double by_x = (cost_at(kStep, 0.0) - cost_at(-kStep, 0.0)) / (2.0 * kStep);
      const double by_y = (cost_at(0.0, kStep) - cost_at(0.0, -kStep)) / (2.0 * kStep);
      EXPECT_NEAR(-normal.gradient.x() / by_x, 1.0, 1e-5);
      EXPECT_NEAR(-normal.gradient.y() / by_y, 1.0, 1e-5);
    }
  }
}

/// Distances to a circle from a point inside and from its inverse point, R²/d from the centre on
/// the same side, have the same ratio everywhere (Apollonius), and levels are free.
TEST(RssiFit, ACircleLeavesTheInversePoint) {
  Rng rng(4);
  const double radius = 2.0;
  const Path path = loop(kTwoPi * radius, 0.02);
  const Eigen::Vector3d center(0.0, radius, 0.4);
  const Eigen::Vector3d p_WT = center + Eigen::Vector3d(1.0, 0.3, 0.0);
  const double d2 = (p_WT - center).squaredNorm();
  const Eigen::Vector3d inverse = center + radius * radius / d2 * (p_WT - center);
  std::vector<PhaseSample> samples = read_along(path, p_WT, Noise{}, rng);
  for (PhaseSample& sample : samples) {
    sample.rssi_dbm = -30.0 - 40.0 * std::log10((p_WT - sample.p_WA).norm()) + normal(rng, 1.0);
  }
  const TagEstimate estimate = locate_one(trilateration_method(), one_tag({{"a", samples}}, 0.4));
  ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous) << estimate.reason;
  EXPECT_EQ(estimate.candidates.size(), 2u);
  EXPECT_LT(nearest(estimate, p_WT), 0.2);
  EXPECT_LT(nearest(estimate, inverse), 0.5);
}

}  // namespace
}  // namespace tagfield
