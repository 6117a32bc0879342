// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_curves/hyperbola.h"

#include <gtest/gtest.h>

#include "method_study.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using namespace made;

TagEstimate locate(const SamplesOfTag& samples, double height,
                   const HyperbolaOptions& options = {}) {
  return locate_by_hyperbolae("t", samples, height, options, {});
}

Tally tally_of(const Study& study, const MakePath& make, const HyperbolaOptions& options = {}) {
  return run(hyperbola_method(options), study, make);
}

TEST(Hyperbola, MeetsTheContractOnACurvedPath) {
  const Tally tally = tally_of({}, make_aisles);
  EXPECT_EQ(tally.errors.size(), 300u);
  EXPECT_LT(tally.mean(), 0.004);       // contract: 15 mm
  EXPECT_LT(tally.part(0.95), 0.015);   // contract: 50 mm
  EXPECT_LT(tally.errors.back(), 0.1);  // contract: 300 mm
}

TEST(Hyperbola, MeetsTheContractAboveTheAntenna) {
  Study study;
  study.lowest = 0.75;
  study.highest = 0.95;
  const Tally tally = tally_of(study, make_aisles);
  EXPECT_EQ(tally.errors.size(), 300u);
  EXPECT_LT(tally.mean(), 0.005);  // contract: 20 mm
  EXPECT_LT(tally.errors.back(), 0.1);
}

// Tags 5 to 60 cm above the assumed plane: positions are off by centimetres, and so are the
// expected errors.
TEST(Hyperbola, ErrsAsItSaysWhereTheHeightIsUnknown) {
  Study study;
  study.seeds = 8;
  study.height_known = false;
  study.lowest = 0.45;
  study.highest = 1.0;
  const Tally tally = tally_of(study, make_aisles);
  EXPECT_GE(tally.errors.size(), 70u);
  EXPECT_GT(tally.mean(), 0.005);
  EXPECT_GT(tally.calibration(), 0.6);
  EXPECT_LT(tally.calibration(), 1.3);
}

TEST(Hyperbola, WithoutRefinementTheBestIntersectionIsGoodToo) {
  HyperbolaOptions options;
  options.refine = false;
  const Tally tally = tally_of({}, make_aisles, options);
  EXPECT_GE(tally.errors.size(), 298u);
  EXPECT_LT(tally.mean(), 0.015);
  EXPECT_GT(tally.mean(), tally_of({}, make_aisles).mean());
}

TEST(Hyperbola, APoseErrorOfACentimetreCostsCentimetres) {
  Study study;
  study.noise.pose_m = 0.01;
  const Tally tally = tally_of(study, make_aisles);
  EXPECT_GE(tally.errors.size(), 290u);
  EXPECT_GT(tally.mean(), 0.010);
  EXPECT_LT(tally.mean(), 0.060);
}

TEST(Hyperbola, NoConfidentWrongAnswerOnAnyShape) {
  Study study;
  study.seeds = 110;
  study.farthest = 6.5;
  const Tally tally = tally_of(study, make_any_shape);
  EXPECT_GT(tally.errors.size(), 1050u);
  EXPECT_EQ(tally.worse_than(0.3), 0u);
  EXPECT_EQ(tally.ambiguous_with_truth, tally.ambiguous);
}

TEST(Hyperbola, LostReadsAndNoiseCostAccuracyNotTruth) {
  Study lossy;
  lossy.seeds = 10;
  lossy.noise.lost = 0.3;
  EXPECT_LT(tally_of(lossy, make_aisles).part(1.0), 0.1);
  for (const double sigma : {0.3, 0.5}) {
    Study noisy;
    noisy.seeds = 10;
    noisy.noise.phase_rad = sigma;
    const Tally tally = tally_of(noisy, make_aisles);
    EXPECT_LT(tally.mean(), 0.02) << sigma;
    EXPECT_EQ(tally.worse_than(0.3), 0u) << sigma;
  }
}

TEST(Hyperbola, AnySpeedWillDo) {
  for (const double speed : {0.1, 0.5, 0.8}) {
    Study study;
    study.seeds = 4;
    const Tally tally = tally_of(study, [=](Rng&) { return aisles(speed / 15.0); });
    EXPECT_EQ(tally.errors.size(), 40u) << speed;
    EXPECT_LT(tally.errors.back(), 0.1) << speed;
  }
}

TEST(Hyperbola, AStraightPathLeavesTheMirrorImage) {
  Study study;
  study.nearest = 0.5;
  study.farthest = 5.0;
  for (const double jitter : {0.0, 0.003, 0.01}) {
    study.noise.pose_m = jitter;
    study.noise.pose_time = 0.0;
    const Tally tally = tally_of(study, make_straight);
    EXPECT_EQ(tally.ambiguous, 300) << jitter;
    EXPECT_EQ(tally.ambiguous_with_truth, 300) << jitter;
  }
}

TEST(Hyperbola, AStraightPathWithADriftingPoseIsAmbiguousToo) {
  Study study;
  study.nearest = 0.5;
  study.farthest = 5.0;
  study.noise.pose_m = 0.01;
  const Tally tally = tally_of(study, make_straight);
  EXPECT_EQ(tally.errors.size(), 0u);
  EXPECT_GE(tally.ambiguous_with_truth, 270);
}

TEST(Hyperbola, BothMirrorImagesAreNamed) {
  Rng rng(11);
  const Eigen::Vector3d p_WT(4.0, 2.0, 0.9);
  const auto samples = read_along(straight(8.0, 0.02), p_WT, Noise{}, rng);
  const TagEstimate estimate = locate({{"a", samples}}, p_WT.z());
  ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous);
  ASSERT_EQ(estimate.candidates.size(), 2u);
  EXPECT_LT(nearest(estimate, p_WT), 0.05);
  EXPECT_LT(nearest(estimate, {4.0, -2.0, 0.9}), 0.05);
  EXPECT_LE(estimate.candidates[0].rms_m, estimate.candidates[1].rms_m);
  EXPECT_FALSE(estimate.reason.empty());
}

TEST(Hyperbola, ATurnTellsTheMirrorImagesApart) {
  Study study;
  study.seeds = 10;
  study.nearest = 0.5;
  const Tally tally = tally_of(study, [](Rng&) { return l_turn(4.0, 2.0, 0.02); });
  EXPECT_EQ(tally.errors.size(), 100u);
  EXPECT_LT(tally.errors.back(), 0.3);
}

TEST(Hyperbola, QualityIsTheNoiseAndTheExpectedErrorIsHonest) {
  Rng rng(12);
  const Eigen::Vector3d p_WT(4.0, 3.0, 0.4);
  const auto samples = read_along(s_curve(15.0, 0.02), p_WT, Noise{}, rng);
  const TagEstimate estimate = locate({{"a", samples}}, 0.4);
  ASSERT_EQ(estimate.verdict, Verdict::kLocated);
  EXPECT_EQ(estimate.tag, "t");
  EXPECT_TRUE(estimate.reason.empty());
  EXPECT_NEAR(estimate.candidates[0].rms_m, 0.1 * wavelength(865.7e6) / (4.0 * kPi), 3e-4);
  EXPECT_LT(level_error(estimate.candidates[0], p_WT),
            4.0 * estimate.candidates[0].expected_error_m);
  EXPECT_NEAR(static_cast<double>(estimate.reads), static_cast<double>(samples.size()), 40.0);
}

TEST(Hyperbola, AVerticalPathLeavesACircle) {
  Rng rng(13);
  Path path;
  for (int i = 0; i < 150; ++i) path.emplace_back(0.0, 0.0, 0.01 * i);
  const auto samples = read_along(path, {2.0, 1.0, 0.8}, Noise{}, rng);
  const TagEstimate estimate = locate({{"a", samples}}, 0.8);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_NE(estimate.reason.find("geometry too weak"), std::string::npos) << estimate.reason;
  EXPECT_TRUE(estimate.candidates.empty());
}

TEST(Hyperbola, AnAntennaThatAlsoMovesUpAndDownLocates) {
  Study study;
  study.seeds = 5;
  study.highest = 1.5;
  const Tally tally = tally_of(study, [](Rng&) {
    Path path = aisles(0.02);
    for (std::size_t i = 0; i < path.size(); ++i) {
      path[i].z() += 0.75 - 0.75 * std::cos(0.02 * static_cast<double>(i));
    }
    return path;
  });
  EXPECT_EQ(tally.errors.size(), 50u);
  EXPECT_LT(tally.errors.back(), 0.05);
}

TEST(Hyperbola, WhatCannotBeLocatedSaysWhy) {
  Rng rng(14);
  EXPECT_EQ(locate({}, 0.4).reason,
            "cannot localize: no reads that have an antenna pose and a phase");
  EXPECT_EQ(locate({{"a", {}}}, 0.4).reason,
            "cannot localize: no reads that have an antenna pose and a phase");
  const Path still(50, Eigen::Vector3d(1.0, 1.0, 0.4));
  const auto samples = read_along(still, {2.0, 2.0, 0.4}, Noise{}, rng);
  const TagEstimate estimate = locate({{"a", samples}}, 0.4);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_EQ(estimate.reason, "cannot localize: the antenna moved only 0.00 m");
  const std::vector<PhaseSample> few(samples.begin(), samples.begin() + 3);
  EXPECT_EQ(locate({{"a", few}}, 0.4).reason,
            "cannot localize: only 3 reads, at least 8 are needed");
  const auto some = read_along(straight(0.2, 0.02), {2.0, 2.0, 0.4}, Noise{}, rng);
  EXPECT_NE(locate({{"a", some}}, 0.4).reason.find("too few reads"), std::string::npos);
  const auto sparse = read_along(straight(40.0, 0.5), {2.0, 2.0, 0.4}, Noise{}, rng);
  EXPECT_EQ(
      locate({{"a", sparse}}, 0.4).reason,
      "cannot localize: the antenna moved too far between reads for the phase to be followed");
}

TEST(Hyperbola, NoiseThatSlipsUnseenIsRefused) {
  Study study;
  study.seeds = 10;
  study.noise.phase_rad = 0.75;
  EXPECT_EQ(tally_of(study, make_aisles).errors.size(), 0U);
  Rng rng(18);
  const auto samples = read_along(aisles(0.02), {4.0, 2.0, 0.4}, study.noise, rng);
  EXPECT_NE(locate({{"a", samples}}, 0.4).reason.find("too much to unwrap"), std::string::npos);
  study.noise.phase_rad = 0.5;
  const Tally tally = tally_of(study, make_aisles);
  EXPECT_GE(tally.errors.size(), 95U);
  EXPECT_GT(tally.calibration(), 0.6);
  EXPECT_LT(tally.calibration(), 1.3);
}

TEST(Hyperbola, ATagThatRidesAlongIsNotLocated) {
  Rng rng(15);
  auto samples = read_along(aisles(0.02), {4.0, 2.0, 0.4}, Noise{}, rng);
  for (PhaseSample& sample : samples) sample.phase_rad = wrap_to_two_pi(1.0 + normal(rng, 0.1));
  EXPECT_EQ(locate({{"a", samples}}, 0.4).verdict, Verdict::kNotLocated);
}

TEST(Hyperbola, AMovingTagIsNotLocated) {
  Rng rng(16);
  const Path path = aisles(0.02);
  const auto samples =
      read_along(path, path, {4.0, 2.0, 0.4}, Noise{}, rng, ReaderSetup{}, {0.05, 0.08, 0.0});
  const TagEstimate estimate = locate({{"a", samples}}, 0.4);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_NE(estimate.reason.find("at rest"), std::string::npos) << estimate.reason;
}

TEST(Hyperbola, SeveralAntennasJoinAndAFixedOneDoesNotDisturb) {
  Rng rng(17);
  const Eigen::Vector3d p_WT(3.0, 2.0, 0.9);
  const Path path = straight(6.0, 0.02);
  Path across = straight(6.0, 0.02, 1.2);
  for (Eigen::Vector3d& p : across) p.z() = 0.8;
  const Path fixed(400, Eigen::Vector3d(1.0, 3.0, 2.0));
  SamplesOfTag samples;
  samples["a"] = read_along(path, p_WT, Noise{}, rng);
  EXPECT_EQ(locate(samples, 0.9).verdict, Verdict::kAmbiguous);
  samples["b"] = read_along(across, p_WT, Noise{}, rng);
  const TagEstimate both = locate(samples, 0.9);
  ASSERT_EQ(both.verdict, Verdict::kLocated);
  EXPECT_LT(level_error(both.candidates[0], p_WT), 0.03);
  samples["fixed"] = read_along(fixed, p_WT, Noise{}, rng);
  const TagEstimate all = locate(samples, 0.9);
  ASSERT_EQ(all.verdict, Verdict::kLocated);
  EXPECT_EQ(all.candidates[0].p_WT, both.candidates[0].p_WT);
  EXPECT_EQ(all.reads, both.reads);
}

TEST(Hyperbola, BadOptionsAreErrors) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  HyperbolaOptions options;
  options.stride_m = 0.0;
  EXPECT_THROW(locate({}, 0.4, options), Error);
  options = {};
  options.max_step = nan;
  EXPECT_THROW(locate({}, 0.4, options), Error);
  EXPECT_THROW(locate({}, nan), Error);
}

}  // namespace
}  // namespace tagfield
