// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/fit_candidates.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

struct Fitted {
  TagPhases phases;
  HeightModel height;
  TagFit fit;
};

Fitted fitted(const made::Hall& hall) {
  Fitted result;
  result.phases = wrapped_phases(hall.problem, hall.problem.samples.at("t0"), {"a"});
  result.height = height_model(hall.problem, "t0", result.phases);
  result.fit =
      fit_tag(result.phases, result.height, to_unknowns(result.height, hall.truth.at("t0")));
  return result;
}

TEST(HonestCovariance, IsThatOfAllPairsOfReads) {
  made::Rng rng(1);
  const made::Path path = made::s_curve(10.0, 0.04);
  made::Hall hall = made::hall(path, path, 1, {}, rng);
  hall.problem.pose_error = PoseErrorModel{0.015, 0.0, 3.0};
  const Fitted of = fitted(hall);
  const Eigen::Matrix2d found =
      honest_covariance(of.phases, of.height, of.fit).topLeftCorner<2, 2>();
  // The least-squares estimate is A y with A = (JᵀJ)⁻¹ Jᵀ, so its covariance is A R Aᵀ with the
  // full covariance R of the ranges.
  const Eigen::Index n = of.phases.size();
  Eigen::MatrixXd J(n, 2);
  Eigen::MatrixXd u(n, 2);
  for (Eigen::Index i = 0; i < n; ++i) {
    u.row(i) = range_to(of.height, of.fit.unknowns, of.phases.x[i], of.phases.y[i], of.phases.z[i])
                   .gradient.head<2>()
                   .transpose();
  }
  J = u.rowwise() - u.colwise().mean();
  Eigen::MatrixXd R(n, n);
  for (Eigen::Index i = 0; i < n; ++i) {
    for (Eigen::Index j = 0; j < n; ++j) {
      const double apart = std::abs(of.phases.time_s[i] - of.phases.time_s[j]);
      R(i, j) = u.row(i).dot(u.row(j)) * 0.015 * 0.015 * std::exp(-apart / 3.0);
    }
    R(i, i) += std::pow(0.1 / of.phases.wavenumber[i], 2);
  }
  const Eigen::MatrixXd A = (J.transpose() * J).inverse() * J.transpose();
  const Eigen::Matrix2d expected = A * R * A.transpose();
  // The phase noise is estimated to within a few per cent.
  EXPECT_LT((found - expected).norm(), 0.02 * expected.norm());
}

TEST(NeighbourDifferences, TellTheNoiseUnderSlowErrors) {
  made::Rng rng(2);
  made::Noise noise;
  noise.phase_rad = 0.2;
  noise.pose_m = 0.03;
  noise.pose_time = 60.0;
  const made::Hall hall = made::hall(made::s_curve(20.0, 0.02), 1, noise, rng);
  const Fitted of = fitted(hall);
  const auto errors = residuals_of(of.phases, of.height, of.fit);
  // Errors of 3 cm would be over a radian.
  EXPECT_NEAR(noise_of_differences(neighbour_differences(of.phases, errors)), 0.2, 0.04);
}

TEST(SpreadStarts, LieAlongTheWeakDirection) {
  made::Rng rng(3);
  const made::Path path = made::straight(3.0, 0.02);
  const Fitted of = fitted(made::hall(path, path, 1, {}, rng));
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(0, 0) = 0.09;
  covariance(1, 1) = 1e-6;
  const auto starts = spread_starts(of.phases, of.height, of.fit, covariance);
  ASSERT_GT(starts.size(), 2U);
  EXPECT_TRUE(starts.front() == of.fit.unknowns);
  for (const PositionVector& start : starts) {
    EXPECT_NEAR(start.y(), of.fit.unknowns.y(), 1e-9);
    EXPECT_LE(std::abs(start.x() - of.fit.unknowns.x()), 0.9 + 1e-9);
  }
  covariance *= 1e-6;
  EXPECT_EQ(spread_starts(of.phases, of.height, of.fit, covariance).size(), 1U);
}

/// Largest change of a range, less what all share, between neighbouring starts [wavelengths].
double largest_change(const Fitted& of, const std::vector<PositionVector>& starts, bool less_mean) {
  const auto ranges = [&](const PositionVector& start) {
    Eigen::ArrayXd r(of.phases.size());
    for (Eigen::Index i = 0; i < r.size(); ++i) {
      r[i] = range_to(of.height, start, of.phases.x[i], of.phases.y[i], of.phases.z[i]).r;
    }
    return r;
  };
  Eigen::ArrayXd change = ranges(starts[1]) - ranges(starts[0]);
  if (less_mean) change -= 0.5 * (change.maxCoeff() + change.minCoeff());
  return change.abs().maxCoeff() / (2.0 * of.phases.spans.front().cycle_m);
}

TEST(SpreadStarts, AreAnEighthOfAWavelengthApart) {
  made::Rng rng(3);
  const made::Path path = made::straight(3.0, 0.02);
  Fitted of = fitted(made::hall(path, path, 1, {}, rng));
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  covariance(0, 0) = 0.09;
  covariance(1, 1) = 1e-6;
  // An unknown offset takes what all ranges share; a known one leaves all of it.
  const auto unknown = spread_starts(of.phases, of.height, of.fit, covariance);
  EXPECT_NEAR(largest_change(of, unknown, true), 0.125, 0.02);
  of.phases.spans.front().offset_known = true;
  const auto known = spread_starts(of.phases, of.height, of.fit, covariance);
  EXPECT_NEAR(largest_change(of, known, false), 0.125, 0.02);
  EXPECT_GT(known.size(), unknown.size());
}

}  // namespace
}  // namespace tagfield
