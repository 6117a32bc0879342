// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/tag_fit.h"

#include <gtest/gtest.h>

#include "tagfield/localization/phase_curves/phase_following.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

made::Hall hall_of_one_tag(double noise, double z, unsigned seed) {
  made::Rng rng(seed);
  const made::Path path = made::s_curve(12.0, 0.03);
  made::Noise of;
  of.phase_rad = noise;
  of.range_sigma = 0.0;
  return made::hall(path, path, 1, of, rng, z);
}

TagPhases wrapped(const made::Hall& hall) {
  return wrapped_phases(hall.problem, hall.problem.samples.at("t0"), {"a"});
}

TEST(TagFit, FindsTheExactPlaceFromWrappedPhase) {
  const made::Hall hall = hall_of_one_tag(0.0, 0.4, 1);
  const TagPhases phases = wrapped(hall);
  const HeightModel height = height_model(hall.problem, "t0", phases);
  const Eigen::Vector3d truth = hall.truth.at("t0");
  const TagFit fit = fit_tag(phases, height, truth + Eigen::Vector3d(0.01, -0.008, 0.0));
  EXPECT_LT((to_position(height, fit.unknowns) - truth).norm(), 1e-6);
  EXPECT_LT(fit.cost, 1e-9);
}

TEST(TagFit, FindsTheHeightOnTheStatedSide) {
  made::Hall hall = hall_of_one_tag(0.0, 1.1, 2);
  hall.problem.heights.of_all.reset();
  for (const HeightSide side : {HeightSide::kAbove, HeightSide::kBelow}) {
    hall.problem.heights.estimated = side;
    const TagPhases phases = wrapped(hall);
    const HeightModel height = height_model(hall.problem, "t0", phases);
    EXPECT_EQ(height.unknowns(), 3);
    const Eigen::Vector3d truth = hall.truth.at("t0");
    PositionVector start = to_unknowns(height, truth);
    start[2] = 0.36;
    const Eigen::Vector3d found = to_position(height, fit_tag(phases, height, start).unknowns);
    // The antenna is at 0.4 m, the tag 0.7 m above it, its mirror image 0.7 m below it.
    EXPECT_NEAR(found.z(), side == HeightSide::kAbove ? 1.1 : -0.3, 1e-5);
    EXPECT_LT((found - truth).head<2>().norm(), 1e-5);
  }
}

TEST(TagFit, NormalMatrixIsThatOfDifferences) {
  const made::Hall hall = hall_of_one_tag(0.1, 0.9, 3);
  const TagPhases phases = wrapped(hall);
  const HeightModel height = height_model(hall.problem, "t0", phases);
  const PositionVector at = to_unknowns(height, hall.truth.at("t0"));
  const Eigen::Matrix3d normal = normal_of(phases, height, at);
  // Derivatives of the residuals by finite differences; their mean is removed, as by the offset.
  constexpr double kStep = 1e-6;
  Eigen::MatrixXd J(phases.size(), 2);
  for (Eigen::Index c = 0; c < 2; ++c) {
    for (Eigen::Index i = 0; i < phases.size(); ++i) {
      PositionVector more = at;
      PositionVector less = at;
      more[c] += kStep;
      less[c] -= kStep;
      const auto r = [&](const PositionVector& p) {
        return range_to(height, p, phases.x[i], phases.y[i], phases.z[i]).r;
      };
      J(i, c) = (r(more) - r(less)) / (2.0 * kStep) * phases.wavenumber[i];
    }
    J.col(c).array() -= J.col(c).mean();
  }
  const Eigen::Matrix2d expected = J.transpose() * J;
  EXPECT_LT((normal.topLeftCorner<2, 2>() - expected).norm(), 1e-6 * expected.norm());
  EXPECT_EQ(normal(2, 2), 1.0);
}

TEST(TagFit, StaysFiniteWhereReadsGiveNoInformation) {
  made::Hall hall = hall_of_one_tag(0.1, 0.4, 4);
  for (PhaseSample& sample : hall.problem.samples["t0"]["a"]) sample.p_WA = {1.0, 1.0, 0.4};
  const TagPhases phases = wrapped(hall);
  const HeightModel height = height_model(hall.problem, "t0", phases);
  EXPECT_TRUE(fit_tag(phases, height, {1.0, 1.0, 0.0}).unknowns.allFinite());
}

}  // namespace
}  // namespace tagfield
