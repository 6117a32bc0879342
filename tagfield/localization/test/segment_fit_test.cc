#include "tagfield/localization/phase_curves/segment_fit.h"

#include <gtest/gtest.h>

#include <limits>

#include "made_reads.h"

namespace tagfield {
namespace {

using namespace made;

const Eigen::Vector3d kTag(3.0, 2.0, 0.9);

FitData made_data(double phase_rad, double lost = 0.0) {
  Rng rng(7);
  Noise noise{phase_rad, 0.05, lost, 0.0, 0.0};
  return make_fit_data(unwrap(read_along(s_curve(12.0, 0.02), kTag, noise, rng), 0.8), kTag.z());
}

TEST(SegmentFit, NoMisfitAtTheTruthWithoutNoise) {
  const FitData data = made_data(0.0, 0.5);
  EXPECT_GT(data.spans.size(), 5u);
  EXPECT_LT(sum_of_squares(data, kTag.head<2>()), 1e-10);
}

TEST(SegmentFit, SumOfSquaresIsThatOfTheResiduals) {
  const FitData data = made_data(0.1, 0.3);
  const Eigen::Vector2d p(2.5, 2.5);
  const Eigen::ArrayXd errors = residuals(data, p);
  EXPECT_NEAR(sum_of_squares(data, p), errors.square().sum(), 1e-9);
  for (const FitData::Span& span : data.spans) {
    EXPECT_NEAR(errors.segment(span.begin, span.count).mean(), 0.0, 1e-12);
  }
}

TEST(SegmentFit, NormalMatrixIsHalfTheCurvatureWhereNothingMisfits) {
  const FitData data = made_data(0.0);
  const Eigen::Matrix2d normal = normal_matrix(data, kTag.head<2>());
  const double h = 1e-3;
  for (int axis = 0; axis < 2; ++axis) {
    const Eigen::Vector2d move = h * Eigen::Vector2d::Unit(axis);
    const double curvature = (sum_of_squares(data, kTag.head<2>() + move) +
                              sum_of_squares(data, kTag.head<2>() - move)) /
                             (h * h);
    EXPECT_NEAR(normal(axis, axis), 0.5 * curvature, 1e-3 * normal(axis, axis));
  }
}

TEST(Refine, FindsTheTruthFromAMetreAway) {
  const FitData data = made_data(0.0);
  EXPECT_LT((refine(data, {2.3, 2.8}) - kTag.head<2>()).norm(), 1e-6);
}

TEST(Refine, EndsInALocalMinimum) {
  const FitData data = made_data(0.3, 0.3);
  const Eigen::Vector2d p = refine(data, {2.5, 2.5});
  const double least = sum_of_squares(data, p);
  for (const Eigen::Vector2d& move : {Eigen::Vector2d(1e-3, 0.0), Eigen::Vector2d(0.0, 1e-3)}) {
    EXPECT_GT(sum_of_squares(data, p + move), least);
    EXPECT_GT(sum_of_squares(data, p - move), least);
  }
}

TEST(Refine, StaysFiniteWhereThereIsNothingToLearn) {
  FitData data = made_data(0.1);
  data.x.setConstant(1.0);
  data.y.setConstant(1.0);
  EXPECT_TRUE(refine(data, {1.0, 1.0}).allFinite());
}

TEST(Thinned, KeepsEverySegmentWhileThereIsRoom) {
  const FitData data = made_data(0.0, 0.5);
  const FitData thin = thinned(data, 150);
  EXPECT_EQ(thin.spans.size(), data.spans.size());
  EXPECT_LT(thin.distance.size(), 350);
  EXPECT_LT(sum_of_squares(thin, kTag.head<2>()), 1e-10);
  const FitData thinner = thinned(data, 10);
  EXPECT_EQ(thinner.spans.size(), 5u);
}

TEST(CorrectSlips, UndoesThemAndLeavesTheRest) {
  const FitData clean = made_data(0.1);
  FitData slipped = clean;
  const double cycle = slipped.spans[0].cycle_m;
  const Eigen::Index half = slipped.spans[0].count / 2;
  slipped.distance.segment(half, slipped.spans[0].count - half) += cycle;
  EXPECT_EQ(correct_slips(slipped, Eigen::Vector2d(2.7, 2.2)), 1u);  // not even at the truth
  EXPECT_LT((slipped.distance - clean.distance).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(correct_slips(slipped, kTag.head<2>()), 0u);
}

}  // namespace
}  // namespace tagfield
