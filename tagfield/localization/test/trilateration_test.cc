// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/signal_strength/trilateration.h"

#include <gtest/gtest.h>

#include <Eigen/LU>

#include "method_study.h"
#include "tagfield/base/error.h"

namespace tagfield {
namespace {

using namespace made;

struct Strength {
  double level_dbm = -30.0;  ///< At 1 m.
  double slope_db = 40.0;
  double noise_db = 1.0;
  double step_db = 1.0;  ///< 0: not rounded.
};

std::vector<PhaseSample> read_with_rssi(const Path& path, const Eigen::Vector3d& p_WT,
                                        const Strength& strength, Rng& rng) {
  std::vector<PhaseSample> samples = read_along(path, p_WT, Noise{}, rng);
  for (PhaseSample& s : samples) {
    const double exact =
        strength.level_dbm - strength.slope_db * std::log10((p_WT - s.p_WA).norm());
    s.rssi_dbm = exact + normal(rng, strength.noise_db);
    if (strength.step_db > 0.0) {
      s.rssi_dbm = strength.step_db * std::round(s.rssi_dbm / strength.step_db);
    }
  }
  return samples;
}

struct Scene {
  LocalizationProblem problem;
  std::map<std::string, Eigen::Vector3d> truth;
};

Scene make_scene(const Strength& strength, std::uint64_t seed, int tags = 8) {
  Rng rng(seed);
  const Path path = aisles(0.02);
  Scene scene;
  scene.problem.heights.of_all = 0.4;
  for (int k = 0; k < tags; ++k) {
    const std::string tag = "tag" + std::to_string(k);
    scene.truth[tag] = beside(path, uniform(rng, 1.0, 4.0), 0.4, rng);
    scene.problem.samples[tag]["a"] = read_with_rssi(path, scene.truth[tag], strength, rng);
  }
  return scene;
}

/// Random RSSI for all tags except reference tags.
TEST(Trilateration, RssiThatSaysNothingLocatesNothing) {
  for (const int references : {0, 3}) {
    Scene scene = make_scene({}, 7, 8);
    Rng rng(8);
    int number = 0;
    for (auto& [tag, samples] : scene.problem.samples) {
      if (number++ < references) {
        scene.problem.reference_tags[tag] = scene.truth.at(tag);
        continue;
      }
      for (PhaseSample& s : samples["a"]) s.rssi_dbm = std::round(uniform(rng, -75.0, -35.0));
    }
    Diagnostics diagnostics;
    for (const TagEstimate& estimate :
         trilateration_method().locate(scene.problem, 1, diagnostics).estimates) {
      if (scene.problem.reference_tags.count(estimate.tag) > 0) continue;
      EXPECT_EQ(estimate.verdict, Verdict::kNotLocated) << references << " " << estimate.tag;
    }
  }
}

Tally judge_scene(const TrilaterationOptions& options, const Scene& scene) {
  Diagnostics diagnostics;
  Tally tally;
  const LocalizationResult result =
      trilateration_method(options).locate(scene.problem, 1, diagnostics);
  for (const TagEstimate& estimate : result.estimates) {
    if (scene.problem.reference_tags.count(estimate.tag) > 0) continue;
    tally.add(estimate, scene.truth.at(estimate.tag));
  }
  tally.finish();
  return tally;
}

TEST(Trilateration, LocatesToDecimetresByRoundedNoisyRssi) {
  Tally all;
  for (std::uint64_t seed = 1; seed <= 4; ++seed) {
    const Tally tally = judge_scene({}, make_scene({}, seed));
    all.errors.insert(all.errors.end(), tally.errors.begin(), tally.errors.end());
  }
  all.finish();
  EXPECT_GE(all.errors.size(), 28u);
  EXPECT_LT(all.mean(), 0.3);
  EXPECT_LT(all.part(0.9), 0.6);
}

TEST(Trilateration, ExactRssiGivesTheExactPlace) {
  const Scene scene = make_scene({-30.0, 40.0, 0.0, 0.0}, 3);
  TrilaterationOptions options;
  options.slope_sigma_db = 0.0;
  options.bin_m = 0.001;  // Each read by itself.
  const Tally tally = judge_scene(options, scene);
  ASSERT_FALSE(tally.errors.empty());
  EXPECT_LT(tally.errors.back(), 1e-3);
}

/// Twelve positions along each of two sides of a square, four reads at each; RSSI is off by
/// alternately ±0.2 dB. Because of reflections and patterns no mean is trusted to better than half
/// a decibel, so the expected error is that of such a noise, in closed form.
TEST(Trilateration, StrengthsAreBelievedToHalfADecibelAtBest) {
  TrilaterationOptions options;
  options.slope_sigma_db = 0.0;
  options.bin_m = 0.01;
  const Eigen::Vector3d p_WT(4.0, 4.0, 0.4);  // On the search grid, so no grid point is nearer.
  std::vector<PhaseSample> samples;
  Eigen::Matrix<double, 24, 2> slopes;
  for (int i = 0; i < 24; ++i) {
    const Eigen::Vector3d p_WA =
        i < 12 ? Eigen::Vector3d(0.5 * i, 0.0, 0.4) : Eigen::Vector3d(6.0, 0.5 * (i - 11), 0.4);
    const double r = (p_WT - p_WA).norm();
    for (int k = 0; k < 4; ++k) {
      samples.push_back({time_from_seconds(4 * i + k), 0.0, 865.7e6, p_WA,
                         -30.0 - 40.0 * std::log10(r) + (i % 2 == 0 ? 0.2 : -0.2)});
    }
    slopes.row(i) = 40.0 / std::log(10.0) * (p_WT - p_WA).head<2>().transpose() / (r * r);
  }
  slopes.rowwise() -= slopes.colwise().mean().eval();
  const double of_half_a_decibel =
      std::sqrt(0.25 * (slopes.transpose() * slopes).inverse().trace() + 1e-4 / 6.0);
  const TagEstimate estimate =
      locate_one(trilateration_method(options), one_tag({{"a", samples}}, 0.4));
  ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
  EXPECT_LT(level_error(estimate.candidates[0], p_WT), 0.05);
  EXPECT_NEAR(estimate.candidates[0].expected_error_m / of_half_a_decibel, 1.0, 0.02);
}

TEST(Trilateration, TheSlopeIsFoundWithReferenceTagsAndWithout) {
  Scene scene = make_scene({-35.0, 30.0, 0.5, 0.5}, 5);
  const Tally alone = judge_scene({}, scene);
  EXPECT_GE(alone.errors.size(), 6u);
  EXPECT_LT(alone.mean(), 0.5);
  for (const char* tag : {"tag0", "tag1", "tag2"}) {
    scene.problem.reference_tags[tag] = scene.truth.at(tag);
  }
  const Tally with = judge_scene({}, scene);
  EXPECT_EQ(with.errors.size(), 5u);
  EXPECT_LT(with.mean(), 0.3);
}

TEST(Trilateration, AStraightPathLeavesTheMirrorImage) {
  Rng rng(8);
  const Eigen::Vector3d p_WT(4.0, 2.0, 0.4);
  const auto samples = read_with_rssi(straight(8.0, 0.02), p_WT, {}, rng);
  const TagEstimate estimate = locate_one(trilateration_method({}), one_tag({{"a", samples}}, 0.4));
  ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous);
  EXPECT_LT(nearest(estimate, p_WT), 0.7);
  EXPECT_LT(nearest(estimate, {4.0, -2.0, 0.4}), 0.7);
}

TEST(Trilateration, SaysWhatIsMissing) {
  Rng rng(9);
  const auto why = [](const SamplesOfTag& samples) {
    return locate_one(trilateration_method({}), one_tag(samples, 0.4)).reason;
  };
  EXPECT_EQ(why({}), "cannot localize: no reads that have an antenna pose");
  auto samples = read_with_rssi(straight(8.0, 0.02), {4.0, 2.0, 0.4}, {}, rng);
  for (PhaseSample& s : samples) s.rssi_dbm = kNoRssi;
  EXPECT_EQ(why({{"a", samples}}), "cannot localize: no read has an RSSI");
  const auto still = read_with_rssi(Path(50, {1.0, 1.0, 0.4}), {2.0, 2.0, 0.4}, {}, rng);
  EXPECT_EQ(why({{"a", still}}),
            "cannot localize: RSSI from only 1 positions, at least 6 are needed");
}

TEST(Trilateration, BadOptionsAreErrors) {
  TrilaterationOptions options;
  options.slope_db = 0.0;
  EXPECT_THROW(trilateration_method(options), Error);
  options = {};
  options.tag_sigma_db = -1.0;
  EXPECT_THROW(trilateration_method(options), Error);
}

}  // namespace
}  // namespace tagfield
