// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/robust.h"

#include <gtest/gtest.h>

#include "method_study.h"
#include "problem_of.h"
#include "reflections.h"
#include "tagfield/localization/pi_ambiguity.h"

namespace tagfield {
namespace {

using namespace made;

/// Tally over several halls.
Tally amid_reflections(double gain, bool pi_ambiguity, const Noise& noise) {
  Tally tally;
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    Rng rng(seed);
    const Path path = aisles(0.03);
    Hall hall = made::hall(path, believed(path, noise, kPathRate, rng), 6, noise, rng);
    reflect(walls(gain), hall);
    hall.problem.pi_ambiguity = pi_ambiguity;
    if (pi_ambiguity) double_phases(hall.problem.samples);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate :
         robust_method().locate(hall.problem, 2, diagnostics).estimates) {
      tally.add(estimate, hall.truth.at(estimate.tag));
    }
  }
  tally.finish();
  return tally;
}

TEST(Robust, IsRightAndKnowsHowRightAmidStrongReflections) {
  for (const bool pi_ambiguity : {false, true}) {
    const Tally tally = amid_reflections(0.5, pi_ambiguity, Noise{});
    EXPECT_GE(tally.errors.size(), 18U) << pi_ambiguity;  // Of 24.
    EXPECT_LT(tally.errors.back(), 0.3) << pi_ambiguity;
    EXPECT_LT(tally.part(0.5), 0.04) << pi_ambiguity;
    EXPECT_GT(tally.calibration(), 0.4) << pi_ambiguity;
    EXPECT_LT(tally.calibration(), 1.5) << pi_ambiguity;
  }
}

TEST(Robust, PoseErrorsWidenTheSpread) {
  Noise noise;
  noise.pose_m = 0.02;
  const Tally tally = amid_reflections(0.3, false, noise);
  EXPECT_GE(tally.errors.size(), 10U);
  EXPECT_EQ(tally.worse_than(0.3), 0U);
  EXPECT_LT(tally.calibration(), 1.6);
}

TEST(Robust, PlacesTagsInEmptySpaceToo) {
  const Tally tally = amid_reflections(0.0, false, Noise{});
  EXPECT_GE(tally.errors.size(), 22U);
  EXPECT_LT(tally.errors.back(), 0.05);
  EXPECT_LT(tally.calibration(), 1.2);
}

TEST(Robust, NamesBothMirrorImagesOfAStraightWay) {
  Rng rng(5);
  const Path path = straight(8.0, 0.03);
  const Eigen::Vector3d p_WT(3.0, 1.8, 0.4);
  const TagEstimate estimate =
      locate_one(robust_method(), one_tag({{"a", read_along(path, p_WT, Noise{}, rng)}}, 0.4));
  ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous) << estimate.reason;
  ASSERT_EQ(estimate.candidates.size(), 2U);
  EXPECT_LT(nearest(estimate, p_WT), 0.05);
  EXPECT_LT(nearest(estimate, {3.0, -1.8, 0.4}), 0.05);
}

TEST(Robust, EstimatesHeights) {
  Rng rng(6);
  const Path path = aisles(0.03);
  int located = 0;
  for (const double up : {0.5, 0.9, 1.3}) {
    const Eigen::Vector3d p_WT = beside(path, 1.7, 0.4 + up, rng);
    LocalizationProblem problem = one_tag({{"a", read_along(path, p_WT, Noise{}, rng)}}, 0.4);
    problem.heights = {};
    problem.heights.estimated = HeightSide::kAbove;
    const TagEstimate estimate = locate_one(robust_method(), problem);
    if (estimate.verdict != Verdict::kLocated) continue;
    ++located;
    EXPECT_LT((estimate.candidates.at(0).p_WT - p_WT).norm(), 0.25) << up;
    EXPECT_GT((*estimate.candidates.at(0).covariance)(2, 2), 0.0) << up;
  }
  EXPECT_GE(located, 2);
}

TEST(Robust, BadOptionsAreErrors) {
  EXPECT_THROW(robust_method({.max_range_m = 0.0}), Error);
  EXPECT_THROW(robust_method({.search_reads = 0}), Error);
}

}  // namespace
}  // namespace tagfield
