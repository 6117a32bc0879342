// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/pose_misfit.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "made_reads.h"

namespace tagfield {
namespace {

using namespace made;

TagPhases two_spans(Rng& rng, Eigen::Index count) {
  TagPhases phases;
  resize(phases, 2 * count);
  double time_s = 0.0;
  for (Eigen::Index i = 0; i < phases.size(); ++i) {
    time_s += uniform(rng, 0.1, 3.0);
    phases.time_s[i] = time_s;
  }
  phases.wavenumber.setConstant(36.0);
  phases.spans = {{0, count, "a", false, 0.17}, {count, count, "a", false, 0.17}};
  return phases;
}

/// Σ eᵀ C⁻¹ e with the full matrix C.
double by_matrices(const TagPhases& phases, const Eigen::ArrayXd& residuals, double white) {
  double sum = 0.0;
  for (const TagPhases::Span& span : phases.spans) {
    Eigen::MatrixXd C = Eigen::MatrixXd::Constant(span.count, span.count, 100.0);
    for (Eigen::Index i = 0; i < span.count; ++i) {
      for (Eigen::Index j = 0; j < span.count; ++j) {
        const double apart =
            std::abs(phases.time_s[span.begin + i] - phases.time_s[span.begin + j]);
        C(i, j) += std::pow(phases.pose_error->sigma_m, 2) *
                   std::exp(-apart / phases.pose_error->time_constant_s);
      }
      C(i, i) += white;
    }
    const Eigen::VectorXd e = residuals.segment(span.begin, span.count).matrix();
    sum += e.dot(C.fullPivLu().solve(e));
  }
  return sum;
}

TEST(PoseMisfit, IsThatOfTheWholeCovariance) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    TagPhases phases = two_spans(rng, 12);
    phases.pose_error = PoseErrorModel{uniform(rng, 0.005, 0.05), 0.0, uniform(rng, 0.5, 20.0)};
    Eigen::ArrayXd residuals(phases.size());
    for (double& one : residuals) one = normal(rng, 0.02) + 0.03;
    const double white = uniform(rng, 1e-5, 1e-3);
    const double expected = by_matrices(phases, residuals, white);
    EXPECT_NEAR(pose_misfit(phases, residuals, white), expected, 1e-4 * expected);
  }
}

TEST(PoseMisfit, ReadsFarApartHidePoseErrors) {
  Rng rng(2);
  TagPhases phases = two_spans(rng, 12);
  for (Eigen::Index i = 0; i < phases.size(); ++i) phases.time_s[i] = static_cast<double>(i);
  const Eigen::ArrayXd residuals = Eigen::ArrayXd::Zero(phases.size());
  EXPECT_FALSE(hides_pose_errors(phases, residuals));  // None is stated.
  phases.pose_error = PoseErrorModel{0.02, 0.0, 5.0};
  EXPECT_TRUE(hides_pose_errors(phases, residuals));
  phases.time_s *= 0.1;
  EXPECT_FALSE(hides_pose_errors(phases, residuals));
}

}  // namespace
}  // namespace tagfield
