// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/plane_fit.h"

#include <gtest/gtest.h>

#include <limits>

#include "made_reads.h"
#include "tagfield/localization/phase_curves/unwrap.h"

namespace tagfield {
namespace {

using namespace made;

const Eigen::Vector3d kTag(3.0, 2.0, 0.9);

TagPhases made_data(double phase_rad, double lost = 0.0) {
  Rng rng(7);
  Noise noise{phase_rad, 0.05, lost, 0.0, 0.0};
  auto segments = unwrap(read_along(s_curve(12.0, 0.02), kTag, noise, rng), 0.8);
  std::erase_if(segments, [](const PhaseSegment& segment) { return segment.samples.size() < 2; });
  return unwrapped_phases(segments, std::vector<std::string>(segments.size(), "a"));
}

TEST(PlaneFit, NoMisfitAtTheTruthWithoutNoise) {
  const TagPhases data = made_data(0.0, 0.5);
  EXPECT_GT(data.spans.size(), 5u);
  EXPECT_LT(sum_of_squares(data, kTag.z(), kTag.head<2>()), 1e-10);
}

TEST(PlaneFit, SumOfSquaresIsThatOfTheResiduals) {
  const TagPhases data = made_data(0.1, 0.3);
  const Eigen::Vector2d p(2.5, 2.5);
  const Eigen::ArrayXd errors = residuals(data, kTag.z(), p);
  EXPECT_NEAR(sum_of_squares(data, kTag.z(), p), errors.square().sum(), 1e-9);
  for (const TagPhases::Span& span : data.spans) {
    EXPECT_NEAR(errors.segment(span.begin, span.count).mean(), 0.0, 1e-12);
  }
}

TEST(Refine, FindsTheTruthFromAMetreAway) {
  const TagPhases data = made_data(0.0);
  EXPECT_LT((refine(data, kTag.z(), {2.3, 2.8}) - kTag.head<2>()).norm(), 1e-6);
}

TEST(Refine, EndsInALocalMinimum) {
  const TagPhases data = made_data(0.3, 0.3);
  const Eigen::Vector2d p = refine(data, kTag.z(), {2.5, 2.5});
  const double least = sum_of_squares(data, kTag.z(), p);
  for (const Eigen::Vector2d& move : {Eigen::Vector2d(1e-3, 0.0), Eigen::Vector2d(0.0, 1e-3)}) {
    EXPECT_GT(sum_of_squares(data, kTag.z(), p + move), least);
    EXPECT_GT(sum_of_squares(data, kTag.z(), p - move), least);
  }
}

TEST(Refine, StaysFiniteWhereThereIsNothingToLearn) {
  TagPhases data = made_data(0.1);
  data.x.setConstant(1.0);
  data.y.setConstant(1.0);
  EXPECT_TRUE(refine(data, kTag.z(), {1.0, 1.0}).allFinite());
}

TEST(Thinned, KeepsEverySegmentWhileThereIsRoom) {
  const TagPhases data = made_data(0.0, 0.5);
  const TagPhases thin = thinned(data, Eigen::Index{150});
  EXPECT_EQ(thin.spans.size(), data.spans.size());
  EXPECT_LT(thin.value.size(), 350);
  EXPECT_LT(sum_of_squares(thin, kTag.z(), kTag.head<2>()), 1e-10);
  const TagPhases thinner = thinned(data, Eigen::Index{10});
  EXPECT_EQ(thinner.spans.size(), 5u);
}

TEST(CorrectSlips, UndoesThemAndLeavesTheRest) {
  const TagPhases clean = made_data(0.1);
  TagPhases slipped = clean;
  const double cycle = slipped.spans[0].cycle_m;
  const Eigen::Index half = slipped.spans[0].count / 2;
  slipped.value.segment(half, slipped.spans[0].count - half) += cycle;
  EXPECT_EQ(correct_slips(slipped, kTag.z(), Eigen::Vector2d(2.7, 2.2)),
            1u);  // not even at the truth
  EXPECT_LT((slipped.value - clean.value).abs().maxCoeff(), 1e-9);
  EXPECT_EQ(correct_slips(slipped, kTag.z(), kTag.head<2>()), 0u);
}

}  // namespace
}  // namespace tagfield
