// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/particle.h"

#include <gtest/gtest.h>

#include "method_study.h"
#include "tagfield/base/error.h"
#include "tagfield/localization/holograms/sar.h"

namespace tagfield {
namespace {

using namespace made;

const Method& particle() {
  static const Method method = particle_method({});
  return method;
}

TEST(Particle, ComesNearTheBoundOnACurvedPath) {
  Study study;
  study.seeds = 3;
  const Tally tally = run(particle(), study, make_aisles);
  EXPECT_EQ(tally.errors.size(), 30u);
  EXPECT_LT(tally.mean(), 0.003);
  EXPECT_LT(tally.errors.back(), 0.05);
  study.noise.phase_rad = 0.5;
  const Tally noisy = run(particle(), study, make_aisles);
  EXPECT_GE(noisy.errors.size(), 27u);
  EXPECT_LT(noisy.mean(), 0.015);
  EXPECT_EQ(noisy.worse_than(0.3), 0u);
}

TEST(Particle, AKnownOffsetAndAnUnknownHeight) {
  Study study;
  study.seeds = 2;
  study.offset_known = true;
  const Tally known = run(particle(), study, make_aisles);
  EXPECT_GE(known.errors.size(), 19u);
  EXPECT_LT(known.mean(), 0.001);
  study.offset_known = false;
  study.lowest = 0.75;
  study.highest = 0.95;
  study.height_known = false;
  const Tally high = run(particle(), study, make_aisles);
  EXPECT_GE(high.errors.size(), 19u);
  EXPECT_LT(high.part(0.9), 0.02);
  EXPECT_LT(high.height_errors.back(), 0.1);
}

TEST(Particle, AStraightPathLeavesTheMirrorImage) {
  Study study;
  study.seeds = 2;
  const Tally tally = run(particle(), study, make_straight);
  EXPECT_EQ(tally.ambiguous, 20);
  EXPECT_EQ(tally.ambiguous_with_truth, 20);
}

/// With all particles in one mode, their mean is near the most likely position.
TEST(Particle, AgreesWithTheHologram) {
  Rng rng(3);
  const Eigen::Vector3d p_WT(4.0, 2.5, 0.4);
  const auto samples = read_along(s_curve(15.0, 0.02), p_WT, Noise{}, rng);
  const LocalizationProblem problem = one_tag({{"a", samples}}, 0.4);
  const TagEstimate ours = locate_one(particle(), problem);
  const TagEstimate other = locate_one(sar_method({}), problem);
  ASSERT_EQ(ours.verdict, Verdict::kLocated);
  EXPECT_LT(level_error(ours.candidates.at(0), other.candidates.at(0).p_WT),
            2.0 * other.candidates.at(0).expected_error_m);
}

/// With thirty reads 0.3 m apart many positions have about the same likelihood, even more so with
/// independent pose errors of 3 cm. If these are stated, particles concentrate less.
TEST(Particle, ClaimsFewerFalsePlacesWherePoseErrorsAreStated) {
  Rng rng(6);
  Noise noise;
  noise.pose_m = 0.03;
  noise.pose_time = 0.0;
  ParticleOptions options;
  options.particles = 600;
  const Method method = particle_method(options);
  const Path path = s_curve(9.0, 0.3);
  Tally stated;
  Tally unstated;
  for (int i = 0; i < 30; ++i) {
    const Eigen::Vector3d p_WT = beside(path, uniform(rng, 1.0, 4.0), 0.4, rng);
    LocalizationProblem problem = one_tag({{"a", read_along(path, p_WT, noise, rng)}}, 0.4);
    unstated.add(locate_one(method, problem), p_WT);
    problem.pose_error = PoseErrorModel{noise.pose_m, 0.0, 1e-3};
    stated.add(locate_one(method, problem), p_WT);
  }
  EXPECT_GE(unstated.worse_than(0.3), 5u);
  EXPECT_LT(2 * stated.worse_than(0.3), unstated.worse_than(0.3));
}

TEST(Particle, TheSeedAndTheTagChooseTheDraws) {
  Rng rng(4);
  const auto samples = read_along(s_curve(10.0, 0.02), {4.0, 2.5, 0.4}, Noise{}, rng);
  const LocalizationProblem problem = one_tag({{"a", samples}}, 0.4);
  const TagEstimate once = locate_one(particle(), problem);
  const TagEstimate again = locate_one(particle(), problem);
  EXPECT_EQ(once.candidates.at(0).p_WT, again.candidates.at(0).p_WT);
  ParticleOptions options;
  options.seed = 2;
  EXPECT_NE(locate_one(particle_method(options), problem).candidates.at(0).p_WT,
            once.candidates.at(0).p_WT);
}

TEST(Particle, BadOptionsAreErrors) {
  ParticleOptions options;
  options.particles = 10;
  EXPECT_THROW(particle_method(options), Error);
  options = {};
  options.max_range_m = -1.0;
  EXPECT_THROW(particle_method(options), Error);
}

}  // namespace
}  // namespace tagfield
