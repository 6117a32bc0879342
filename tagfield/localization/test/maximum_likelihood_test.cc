// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/maximum_likelihood.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "tagfield/localization/bound.h"
#include "tagfield/localization/phase_curves/least_squares.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

struct Sums {
  double error = 0.0;
  double bound = 0.0;
  double nees = 0.0;
  double worst = 0.0;
  int located = 0;
  int others = 0;
};

struct Conditions {
  made::Noise noise;
  bool offset_known = false;
  /// Height of the tags; if nullopt, that of the antenna, and known.
  std::optional<double> height;
  unsigned seeds = 12;
};

/// Sums of errors and bounds, over 8 tags per seed on a path of two aisles.
Sums sums_of(const Method& method, const Conditions& setting) {
  Sums sums;
  for (unsigned seed = 1; seed <= setting.seeds; ++seed) {
    made::Rng rng(seed);
    const made::Path path = made::aisles(0.02);
    made::Hall hall = made::hall(path, path, 8, setting.noise, rng, setting.height.value_or(0.4));
    if (setting.height) {
      hall.problem.heights = {};
      hall.problem.heights.estimated = HeightSide::kAbove;
    }
    BoundInput input{hall.problem, hall.truth, {{"a", setting.noise.phase_rad}}};
    const Bounds bounds = single_bounds(input);
    Diagnostics diagnostics;
    const auto estimates = method.locate(hall.problem, 2, diagnostics).estimates;
    for (std::size_t i = 0; i < estimates.size(); ++i) {
      if (estimates[i].verdict != Verdict::kLocated) {
        ++sums.others;
        continue;
      }
      const Candidate& best = estimates[i].candidates.front();
      const Eigen::Vector2d error = (best.p_WT - hall.truth.at(estimates[i].tag)).head<2>();
      sums.error += error.norm();
      sums.worst = std::max(sums.worst, error.norm());
      sums.bound += mean_horizontal_error(covariance_of(bounds, i));
      const Eigen::Matrix2d covariance = best.covariance->topLeftCorner<2, 2>();
      sums.nees += error.dot(covariance.inverse() * error);
      ++sums.located;
    }
  }
  return sums;
}

// With 96 tags the mean ratio has a standard deviation of about 0.08.

TEST(MaximumLikelihood, MeetsTheBound) {
  const Sums sums = sums_of(maximum_likelihood_method(), {});
  EXPECT_EQ(sums.others, 0);
  EXPECT_LT(sums.error, 1.25 * sums.bound);
  EXPECT_GT(sums.error, 0.75 * sums.bound);
  // The sum of 96 squared normalized errors in two axes is χ² with 192 degrees of freedom; limits
  // are its quantiles of 0.0005 and 0.9995, widened by a tenth for the estimated noise.
  EXPECT_GT(sums.nees, 0.9 * 132.0);
  EXPECT_LT(sums.nees, 1.1 * 264.0);
}

TEST(MaximumLikelihood, MeetsItAtNoiseOfHalfARadian) {
  Conditions setting;
  setting.noise.phase_rad = 0.5;
  const Sums sums = sums_of(maximum_likelihood_method(), setting);
  EXPECT_LE(sums.others, 1);
  EXPECT_LT(sums.error, 1.3 * sums.bound);
  EXPECT_LT(sums.worst, 0.3);
}

TEST(MaximumLikelihood, MeetsItWhereReadsAreLost) {
  Conditions setting;
  setting.noise.lost = 0.3;
  const Sums sums = sums_of(maximum_likelihood_method(), setting);
  EXPECT_EQ(sums.others, 0);
  EXPECT_LT(sums.error, 1.3 * sums.bound);
}

TEST(MaximumLikelihood, MeetsItWithUnknownHeight) {
  Conditions setting;
  setting.height = 0.9;
  const Sums sums = sums_of(maximum_likelihood_method(), setting);
  EXPECT_EQ(sums.others, 0);
  EXPECT_LT(sums.error, 1.3 * sums.bound);
}

TEST(LeastSquares, MeetsTheBoundWhereThePhaseIsWhole) {
  const Sums sums = sums_of(least_squares_method(), {});
  EXPECT_EQ(sums.others, 0);
  // Segments at the sporadic edge of the range have their own offsets, which costs a little.
  EXPECT_LT(sums.error, 1.5 * sums.bound);
}

TEST(MaximumLikelihood, UsesAKnownOffset) {
  made::Rng rng(2);
  const made::Path path = made::aisles(0.02);
  made::Hall hall = made::hall(path, path, 6, {}, rng);
  // Synthetic reads have a random offset: it is removed, given the true positions.
  for (auto& [tag, samples] : hall.problem.samples) {
    const TagPhases phases = wrapped_phases(hall.problem, samples, {"a"});
    const HeightModel height = height_model(hall.problem, tag, phases);
    const double offset = offsets_at(phases, height, to_unknowns(height, hall.truth.at(tag)))[0];
    for (PhaseSample& sample : samples["a"]) {
      sample.phase_rad = wrap_to_two_pi(sample.phase_rad - offset * phases.wavenumber[0]);
    }
  }
  hall.problem.offset_known.insert("a");
  Diagnostics diagnostics;
  for (const TagEstimate& estimate :
       maximum_likelihood_method().locate(hall.problem, 1, diagnostics).estimates) {
    ASSERT_EQ(estimate.verdict, Verdict::kLocated);
    EXPECT_LT((estimate.candidates[0].p_WT - hall.truth.at(estimate.tag)).norm(), 0.002);
  }
}

TEST(MaximumLikelihood, SaysThatAStraightWayIsAmbiguous) {
  made::Rng rng(4);
  const made::Hall hall = made::hall(made::straight(10.0, 0.02), 5, {}, rng);
  Diagnostics diagnostics;
  for (const Method& method : {maximum_likelihood_method(), least_squares_method()}) {
    for (const TagEstimate& estimate : method.locate(hall.problem, 1, diagnostics).estimates) {
      EXPECT_EQ(estimate.verdict, Verdict::kAmbiguous) << method.name << " " << estimate.tag;
      EXPECT_EQ(estimate.candidates.size(), 2U);
    }
  }
}

}  // namespace
}  // namespace tagfield
