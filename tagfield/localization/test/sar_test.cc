// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/holograms/sar.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "method_study.h"
#include "tagfield/base/error.h"
#include "tagfield/localization/test/reflections.h"

namespace tagfield {
namespace {

using namespace made;

const Method& sar() {
  static const Method method = sar_method({});
  return method;
}

TEST(Sar, MeetsTheBoundOnACurvedPath) {
  Study study;
  study.seeds = 5;
  const Tally tally = run(sar(), study, make_aisles);
  EXPECT_EQ(tally.errors.size(), 50u);
  EXPECT_LT(tally.mean(), 0.002);
  EXPECT_LT(tally.errors.back(), 0.03);
  EXPECT_NEAR(tally.calibration(), 1.0, 0.2);
}

TEST(Sar, FindsTheRightLobeInNoise) {
  Study study;
  study.seeds = 5;
  study.noise.phase_rad = 0.5;
  const Tally tally = run(sar(), study, make_aisles);
  EXPECT_EQ(tally.errors.size(), 50u);
  EXPECT_LT(tally.mean(), 0.010);
  EXPECT_LT(tally.errors.back(), 0.1);
  study.farthest = 6.5;
  const Tally any = run(sar(), study, make_any_shape);
  EXPECT_GE(any.errors.size(), 47u);
  EXPECT_EQ(any.worse_than(0.3), 0u);
  EXPECT_EQ(any.ambiguous_with_truth, any.ambiguous);
}

TEST(Sar, AKnownOffsetGivesTheRangeToo) {
  Study study;
  study.seeds = 5;
  study.offset_known = true;
  const Tally tally = run(sar(), study, make_aisles);
  EXPECT_GE(tally.errors.size(), 48u);
  EXPECT_LT(tally.mean(), 0.0005);
  EXPECT_LT(tally.errors.back(), 0.01);
}

TEST(Sar, AnUnknownHeightIsEstimated) {
  Study study;
  study.seeds = 3;
  study.lowest = 0.75;
  study.highest = 1.35;
  study.height_known = false;
  const Tally tally = run(sar(), study, make_aisles);
  EXPECT_EQ(tally.errors.size(), 30u);
  EXPECT_LT(tally.mean(), 0.005);
  EXPECT_LT(tally.part(0.9), 0.03);
  EXPECT_LT(tally.height_errors.back(), 0.1);
}

TEST(Sar, AHeightIsEstimatedFromAnAntennaThatMovesUpAndDown) {
  Study study;
  study.seeds = 2;
  study.lowest = 0.8;
  study.highest = 1.5;
  study.height_known = false;
  const Tally tally = run(sar(), study, [](Rng&) {
    Path path = aisles(0.02);
    for (std::size_t i = 0; i < path.size(); ++i) {
      path[i].z() += 0.1 - 0.1 * std::cos(0.02 * static_cast<double>(i));
    }
    return path;
  });
  EXPECT_EQ(tally.errors.size(), 20u);
  EXPECT_LT(tally.mean(), 0.005);
  EXPECT_LT(tally.height_errors.back(), 0.1);
}

TEST(Sar, ChannelsHaveOffsetsOfTheirOwn) {
  Study study;
  study.seeds = 3;
  study.channels = 4;
  const Tally four = run(sar(), study, make_aisles);
  EXPECT_EQ(four.errors.size(), 30u);
  EXPECT_LT(four.errors.back(), 0.02);
  study.channels = 20;
  study.dwell = 6;
  const Tally many = run(sar(), study, make_aisles);
  EXPECT_EQ(many.errors.size(), 30u);
  EXPECT_LT(many.errors.back(), 0.02);
}

TEST(Sar, LostReadsAndADriftingPoseCostAccuracyNotTruth) {
  Study lossy;
  lossy.seeds = 3;
  lossy.noise.lost = 0.6;
  EXPECT_LT(run(sar(), lossy, make_aisles).errors.back(), 0.05);
  Study drifting;
  drifting.seeds = 5;
  drifting.noise.pose_m = 0.01;
  const Tally tally = run(sar(), drifting, make_aisles);
  EXPECT_GE(tally.errors.size(), 44u);
  EXPECT_LT(tally.mean(), 0.03);
  EXPECT_EQ(tally.worse_than(0.3), 0u);
}

/// One read per second, as for one tag among hundreds, with a drifting pose whose error is stated.
Tally with_reads_far_apart(const Noise& noise) {
  ReaderSetup setup;
  setup.rate_hz = 1.0;
  Tally tally;
  for (std::uint64_t seed = 0; seed < 40; ++seed) {
    Rng rng(500 + seed);
    const Path path = aisles(0.3);
    const Path beliefs = believed(path, noise, setup.rate_hz, rng);
    for (int k = 0; k < 5; ++k) {
      const Eigen::Vector3d p_WT = beside(path, uniform(rng, 1.0, 3.0), 0.4, rng);
      const auto samples = read_along(path, beliefs, p_WT, noise, rng, setup);
      LocalizationProblem problem = one_tag({{"a", samples}}, 0.4);
      problem.pose_error = PoseErrorModel{noise.pose_m, 0.0, noise.pose_time};
      tally.add(locate_one(sar_method({}), problem), p_WT);
    }
  }
  tally.finish();
  return tally;
}

// The residuals do not show that pose errors are slow.
TEST(Sar, ErrsAsItSaysWhereReadsAreFarApartAndThePoseDrifts) {
  Noise noise;
  noise.pose_m = 0.015;
  const Tally tally = with_reads_far_apart(noise);
  EXPECT_GE(tally.errors.size(), 100U);
  EXPECT_LT(tally.errors.back(), 0.3);
  EXPECT_GT(tally.calibration(), 0.7);
  EXPECT_LT(tally.calibration(), 1.2);
}

// Residuals distinguish fewer lobes than the likelihood under that pose error.
TEST(Sar, ComparesLobesByTheStatedPoseErrorWhereReadsAreFarApart) {
  Noise noise;
  noise.pose_m = 0.03;
  noise.phase_rad = 0.4;
  const Tally tally = with_reads_far_apart(noise);
  EXPECT_GE(tally.errors.size(), 150U);  // By residuals alone, two thirds of these.
  EXPECT_LT(tally.errors.back(), 0.3);
  EXPECT_GT(tally.calibration(), 0.7);
  EXPECT_LT(tally.calibration(), 1.2);
}

TEST(Sar, AStraightPathLeavesTheMirrorImage) {
  Study study;
  study.seeds = 5;
  study.nearest = 0.5;
  study.farthest = 5.0;
  const Tally tally = run(sar(), study, make_straight);
  EXPECT_EQ(tally.ambiguous, 50);
  EXPECT_EQ(tally.ambiguous_with_truth, 50);
}

TEST(Sar, BothMirrorImagesAreNamed) {
  Rng rng(11);
  const Eigen::Vector3d p_WT(4.0, 2.0, 0.9);
  const auto samples = read_along(straight(8.0, 0.02), p_WT, Noise{}, rng);
  const TagEstimate estimate = locate_one(sar(), one_tag({{"a", samples}}, p_WT.z()));
  ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous);
  ASSERT_EQ(estimate.candidates.size(), 2u);
  EXPECT_LT(nearest(estimate, p_WT), 0.05);
  EXPECT_LT(nearest(estimate, {4.0, -2.0, 0.9}), 0.05);
}

TEST(Sar, ASecondAntennaTellsTheMirrorImagesApart) {
  Rng rng(17);
  const Eigen::Vector3d p_WT(3.0, 2.0, 0.9);
  SamplesOfTag samples;
  samples["a"] = read_along(straight(6.0, 0.02), p_WT, Noise{}, rng);
  Path across = straight(6.0, 0.02, 1.2);
  for (Eigen::Vector3d& p : across) p.z() = 0.8;
  samples["b"] = read_along(across, p_WT, Noise{}, rng);
  const TagEstimate both = locate_one(sar(), one_tag(samples, 0.9));
  ASSERT_EQ(both.verdict, Verdict::kLocated);
  EXPECT_LT(level_error(both.candidates[0], p_WT), 0.03);
  // The phase of a stationary antenna carries no information unless its offset is known.
  samples["fixed"] = read_along(Path(400, {1.0, 3.0, 2.0}), p_WT, Noise{}, rng);
  const TagEstimate all = locate_one(sar(), one_tag(samples, 0.9));
  EXPECT_EQ(all.candidates.at(0).p_WT, both.candidates[0].p_WT);
}

/// Adds a reflection of 0.3 of the direct wave in each direction, from a wall behind the tag.
std::vector<PhaseSample> with_reflection(std::vector<PhaseSample> samples,
                                         const Eigen::Vector3d& p_WT, double wall_y) {
  const double k = kTwoPi / wavelength(865.7e6);
  const Eigen::Vector3d image(p_WT.x(), 2.0 * wall_y - p_WT.y(), p_WT.z());
  for (PhaseSample& sample : samples) {
    const double direct = (p_WT - sample.p_WA).norm();
    const double other = (image - sample.p_WA).norm();
    const double extra = k * (other - direct);
    const double gain = -0.3 * direct / other;
    // The signal passes the channel twice, there and back, so its phase counts twice.
    const double turn = std::atan2(-gain * std::sin(extra), 1.0 + gain * std::cos(extra));
    sample.phase_rad = wrap_to_two_pi(sample.phase_rad - 2.0 * turn);
  }
  return samples;
}

TEST(Sar, AReflectionCostsCentimetres) {
  Tally tally;
  Rng rng(23);
  for (int i = 0; i < 20; ++i) {
    const Path path = s_curve(15.0, 0.02);
    const Eigen::Vector3d p_WT{uniform(rng, 3.0, 8.0), uniform(rng, 3.0, 5.0), 0.4};
    const auto samples = with_reflection(read_along(path, p_WT, Noise{}, rng), p_WT, 6.0);
    tally.add(locate_one(sar(), one_tag({{"a", samples}}, 0.4)), p_WT);
  }
  tally.finish();
  EXPECT_GE(tally.errors.size() + static_cast<std::size_t>(tally.ambiguous_with_truth), 19u);
  EXPECT_LT(tally.mean(), 0.1);
  EXPECT_EQ(tally.worse_than(0.3), 0u);
}

/// Brightness computed directly with complex numbers.
double brightness(const std::vector<PhaseSample>& samples, const Eigen::Vector3d& p_WT) {
  std::complex<double> sum = 0.0;
  for (const PhaseSample& s : samples) {
    const double there_and_back = 2.0 * (p_WT - s.p_WA).norm();
    sum += std::polar(1.0, s.phase_rad - kTwoPi / wavelength(s.frequency_hz) * there_and_back);
  }
  return std::abs(sum);
}

TEST(Sar, ADenseGridAgrees) {
  Rng rng(31);
  Noise noise;
  noise.phase_rad = 0.4;
  const Eigen::Vector3d p_WT(1.0, 1.5, 0.4);
  const auto samples = read_along(l_turn(1.5, 1.0, 0.03), p_WT, noise, rng);
  Eigen::Vector3d best = p_WT;
  double most = 0.0;
  for (double x = -1.0; x <= 4.0; x += 0.02) {
    for (double y = -2.0; y <= 4.0; y += 0.02) {
      const double light = brightness(samples, {x, y, 0.4});
      if (light > most) best = {x, y, 0.4};
      most = std::max(most, light);
    }
  }
  const TagEstimate estimate = locate_one(sar(), one_tag({{"a", samples}}, 0.4));
  ASSERT_FALSE(estimate.candidates.empty()) << estimate.reason;
  EXPECT_LT(level_error(estimate.candidates[0], best), 0.015);
  EXPECT_GE(brightness(samples, estimate.candidates[0].p_WT), most);
}

RC_GTEST_PROP(Hologram, BrightnessInSinglePrecisionIsThatInDouble, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const Path path = s_curve(6.0, 0.05);
  const auto samples = read_along(path, {2.0, 2.0, 0.4}, Noise{}, rng);
  const TagPhases phases = coherent_reads({}, {{"a", samples}});
  const Eigen::Vector2d middle(3.0, 0.0);
  Tile x = Tile::Zero();
  Tile y = Tile::Zero();
  x[5] = static_cast<float>(uniform(rng, -9.0, 9.0));
  y[5] = static_cast<float>(uniform(rng, -9.0, 9.0));
  const Tile light = coherent_brightness(search_reads(phases, kWholeAperture, 0.4, middle), x, y);
  const Eigen::Vector3d p(3.0 + static_cast<double>(x[5]), static_cast<double>(y[5]), 0.4);
  RC_ASSERT(std::abs(static_cast<double>(light[5]) - brightness(samples, p)) <
            1e-3 * static_cast<double>(samples.size()));
}

/// With cells so small that what the glance neglects, |u v|/2r, is under 0.2 mm from 1 m on.
RC_GTEST_PROP(Hologram, AGlanceAtABlockIsTheBrightnessOfItsCells, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const Path path = s_curve(6.0, 0.05);
  const auto samples = read_along(path, {2.0, 2.0, 0.4}, Noise{}, rng);
  const TagPhases phases = coherent_reads({}, {{"a", samples}});
  const Eigen::Vector2d middle(3.0, 0.0);
  const CellBlock block{static_cast<float>(uniform(rng, -5.0, 5.0)),
                        static_cast<float>(uniform(rng, 3.0, 9.0)), 0.0025f};
  const BlockLight light =
      approximate_coherence(search_reads(phases, kWholeAperture, 0.4, middle), block);
  for (const int i : {0, 7, 15}) {
    for (const int j : {0, 9, 15}) {
      const double cell = static_cast<double>(block.cell_m);
      const Eigen::Vector3d p(3.0 + static_cast<double>(block.x) + i * cell,
                              static_cast<double>(block.y) + j * cell, 0.4);
      RC_ASSERT(std::abs(static_cast<double>(light(i, j)) - brightness(samples, p)) <
                1e-2 * static_cast<double>(samples.size()));
    }
  }
}

/// A brightness without a glance at blocks is evaluated tile by tile.
TEST(Hologram, AGlanceInTilesLeadsToTheSamePlacesAsOneAtBlocks) {
  Rng rng(5);
  Hall hall = made::hall(aisles(0.02), 4, Noise{}, rng);
  reflect(walls(0.5), hall);
  SearchOptions options;
  options.thorough = true;
  for (const auto& [tag, samples] : hall.problem.samples) {
    const TagPhases phases = coherent_reads(hall.problem, samples);
    const double height = hall.truth.at(tag).z();
    const auto by_blocks = search_plane(phases, height, options, coherent_light());
    const auto in_tiles = search_plane(phases, height, options, {coherent_brightness});
    ASSERT_FALSE(by_blocks.empty());
    EXPECT_EQ(by_blocks.front(), in_tiles.front()) << tag;
    EXPECT_LT((by_blocks.front() - hall.truth.at(tag).head<2>()).norm(), 0.15) << tag;
  }
}

RC_GTEST_PROP(Hologram, WavesAreThoseOfTheAngle, ()) {
  const double turns = *rc::gen::inRange(-500'000, 500'000) * 1e-3;
  float cosine = 0.0f;
  float sine = 0.0f;
  wave_of(static_cast<float>(turns), cosine, sine);
  const double exact = kTwoPi * static_cast<double>(static_cast<float>(turns));
  RC_ASSERT(std::abs(static_cast<double>(cosine) - std::cos(exact)) < 5e-5);
  RC_ASSERT(std::abs(static_cast<double>(sine) - std::sin(exact)) < 5e-5);
}

TEST(Sar, ReflectionsShiftPlacesLittle) {
  // Waves of half the amplitude shift phases by up to 1.05 rad, there and back.
  int located = 0;
  for (const unsigned seed : {1U, 2U, 3U, 4U, 5U}) {
    Rng rng(seed);
    Hall hall = made::hall(aisles(0.02), 8, Noise{}, rng);
    reflect(walls(0.5), hall);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate : sar().locate(hall.problem, 2, diagnostics).estimates) {
      if (estimate.verdict != Verdict::kLocated) continue;
      ++located;
      const Candidate& place = estimate.candidates.front();
      const double error = (place.p_WT - hall.truth.at(estimate.tag)).norm();
      EXPECT_LT(error, 0.15) << seed << " " << estimate.tag;
      EXPECT_LT(error, 5.0 * place.expected_error_m) << seed << " " << estimate.tag;
    }
  }
  EXPECT_GE(located, 36);
}

TEST(Sar, ASearchByFewReadsAndFarAwayIsNoTroubleEither) {
  Rng rng(1);
  Hall hall = made::hall(aisles(0.02), 1, Noise{}, rng);
  reflect(walls(0.5), hall);
  SarOptions options;
  options.reads = 1;
  options.max_range_m = 100.0;
  const TagEstimate estimate = locate_one(sar_method(options), hall.problem);
  for (const Candidate& candidate : estimate.candidates) {
    EXPECT_TRUE(candidate.p_WT.allFinite());
    EXPECT_LT((candidate.p_WT - hall.truth.at("t0")).norm(), 200.0);
  }
}

TEST(Sar, WhatCannotBeLocatedSaysWhy) {
  Rng rng(14);
  const auto why = [](const SamplesOfTag& samples) {
    return locate_one(sar(), one_tag(samples, 0.4)).reason;
  };
  EXPECT_EQ(why({}), "cannot localize: no reads that have an antenna pose and a phase");
  EXPECT_EQ(why({{"a", {}}}), "cannot localize: no reads that have an antenna pose and a phase");
  const auto still = read_along(Path(50, {1.0, 1.0, 0.4}), {2.0, 2.0, 0.4}, Noise{}, rng);
  EXPECT_EQ(why({{"a", still}}), "cannot localize: the antenna moved only 0.00 m");
  EXPECT_EQ(why({{"a", {still[0]}}}), "cannot localize: only 1 reads, at least 8 are needed");
  Path up;
  for (int i = 0; i < 150; ++i) up.emplace_back(0.0, 0.0, 0.01 * i);
  EXPECT_NE(why({{"a", read_along(up, {2.0, 1.0, 0.8}, Noise{}, rng)}}).find("too weak"),
            std::string::npos);
  const auto few = read_along(straight(0.2, 0.02), {2.0, 2.0, 0.4}, Noise{}, rng);
  EXPECT_NE(why({{"a", few}}).find("too few reads"), std::string::npos);
}

TEST(Sar, ATagNotAtRestIsNotLocated) {
  Rng rng(15);
  auto riding = read_along(aisles(0.02), {4.0, 2.0, 0.4}, Noise{}, rng);
  for (PhaseSample& sample : riding) sample.phase_rad = wrap_to_two_pi(1.0 + normal(rng, 0.1));
  EXPECT_EQ(locate_one(sar(), one_tag({{"a", riding}}, 0.4)).verdict, Verdict::kNotLocated);
  const Path path = aisles(0.02);
  const auto moving =
      read_along(path, path, {4.0, 2.0, 0.4}, Noise{}, rng, ReaderSetup{}, {0.05, 0.08, 0.0});
  EXPECT_NE(locate_one(sar(), one_tag({{"a", moving}}, 0.4)).verdict, Verdict::kLocated);
}

TEST(Sar, BadOptionsAreErrors) {
  SarOptions options;
  options.cell_m = 0.0;
  EXPECT_THROW(sar_method(options), Error);
  options = {};
  options.max_range_m = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(sar_method(options), Error);
  options = {};
  options.min_share = 0.0;
  EXPECT_THROW(sar_method(options), Error);
}

}  // namespace
}  // namespace tagfield
