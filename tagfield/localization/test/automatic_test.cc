// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/automatic.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/problem_of.h"
#include "tagfield/localization/test/reflections.h"

namespace tagfield {
namespace {

made::Hall moving_hall(const made::Noise& noise) {
  made::Rng rng(1);
  return made::hall(made::aisles(0.02), 4, noise, rng);
}

Choice choice_for(const LocalizationProblem& problem) {
  return choose_method(traits_of(problem, 1), problem.reference_tags.size());
}

TEST(Automatic, TakesLikelihoodWithAnExactPose) {
  EXPECT_EQ(choice_for(moving_hall({}).problem).method, "ml");
}

TEST(Automatic, TakesTheJointEstimateWithAnyOtherPose) {
  made::Noise noise;
  noise.pose_m = 0.01;
  made::Hall hall = moving_hall(noise);
  EXPECT_EQ(choice_for(hall.problem).method, "joint");
  hall.problem.pose_error.reset();
  EXPECT_EQ(choice_for(hall.problem).method, "joint");
}

TEST(Automatic, SeesReflectionsWhereAnExactPoseDoesNotFit) {
  made::Noise noise;
  noise.pose_m = 0.03;
  noise.pose_time = 0.7;
  made::Hall hall = moving_hall(noise);
  hall.problem.pose_error = PoseErrorModel{};  // The phase must be biased.
  const Choice choice = choice_for(hall.problem);
  EXPECT_EQ(choice.method, "robust");
  EXPECT_NE(choice.why.find("reflections"), std::string::npos);
}

TEST(Automatic, SeesReflectionsWhereNoPoseErrorExplainsThem) {
  made::Hall hall = moving_hall({});
  made::reflect(made::walls(0.5), hall);
  hall.problem.pose_error.reset();
  EXPECT_EQ(choice_for(hall.problem).method, "joint");  // At first.
  Diagnostics diagnostics;
  const Method method = find_method(built_in_methods(), "auto");
  const LocalizationResult result = method.locate(hall.problem, 2, diagnostics);
  EXPECT_EQ(result.method, "robust");
  EXPECT_NE(result.why.find("even with the pose error estimated"), std::string::npos) << result.why;
}

/// Methods with a fake `joint` that refuses all tags because of wrong poses, each with a misfit of
/// `misfit_m`.
std::vector<Method> with_refusing_joint(double misfit_m) {
  std::vector<Method> methods = built_in_methods();
  for (Method& method : methods) {
    if (method.name != "joint") continue;
    method.locate = [misfit_m](const LocalizationProblem& problem, int, Diagnostics& diagnostics) {
      LocalizationResult result;
      result.method = "joint";
      diagnostics.warn("the poses seem to be off");
      for (const auto& [tag, samples] : problem.samples) {
        TagEstimate estimate;
        estimate.tag = tag;
        estimate.reason = "the poses seem to be off";
        result.estimates.push_back(estimate);
        result.misfits_m.push_back(misfit_m);
      }
      return result;
    };
  }
  return methods;
}

TEST(Automatic, StaysWithJointThatRefusedAllUnlessItLeftMoreThanNoise) {
  made::Hall hall = moving_hall({});
  hall.problem.pose_error.reset();
  const double noise_m = traits_of(hall.problem, 1).noise_m;
  for (const bool is_noise : {true, false}) {
    Diagnostics diagnostics;
    const Method method = automatic_method(with_refusing_joint((is_noise ? 1.0 : 3.0) * noise_m));
    const LocalizationResult result = method.locate(hall.problem, 2, diagnostics);
    EXPECT_EQ(result.method, is_noise ? "joint" : "robust");
    EXPECT_EQ(diagnostics.warnings().size(), is_noise ? 1U : 0U);
    EXPECT_EQ(result.estimates.front().verdict,
              is_noise ? Verdict::kNotLocated : Verdict::kLocated);
  }
}

/// Recomputes the true phases on ten carriers 0.5 MHz apart, 8 reads each, with an offset for each.
void hop(const made::Path& path, made::Hall& hall, made::Rng& rng) {
  for (auto& [tag, samples] : hall.problem.samples) {
    for (PhaseSample& sample : samples["a"]) {
      const double time = to_seconds(sample.stamp) - made::ReaderSetup{}.start_s;
      const auto i = static_cast<std::size_t>(std::lround(time * made::kPathRate));
      const auto channel = static_cast<double>(i / 8 * 7 % 10);
      sample.frequency_hz = 902.75e6 + 0.5e6 * channel;
      const double distance = (path.at(i) - hall.truth.at(tag)).norm();
      sample.phase_rad = wrap_to_two_pi(2.0 * kTwoPi / wavelength(sample.frequency_hz) * distance +
                                        2.1 * channel + made::normal(rng, 0.05));
    }
  }
}

TEST(Automatic, AddsUpWavesWhereTheCarrierHops) {
  made::Rng rng(1);
  const made::Path path = made::aisles(0.02);
  made::Hall hall = made::hall(path, 4, {}, rng);
  hop(path, hall, rng);
  const DataTraits traits = traits_of(hall.problem, 1);
  EXPECT_EQ(traits.channels, 10U);
  EXPECT_LT(traits.reads_per_segment, 12.0);
  EXPECT_EQ(choose_method(traits, 0).method, "sar");
}

// For some tags the noise is slightly underestimated: only these could be unwrapped.
TEST(Automatic, AddsUpWavesWhereNoiseLeavesFewPhasesToFollow) {
  made::Noise noise;
  noise.phase_rad = 0.6;
  made::Rng rng(2);
  const made::Path path = made::aisles(0.02);
  const made::Hall hall = made::hall(path, 12, noise, rng);
  const DataTraits traits = traits_of(hall.problem, 1);
  EXPECT_GE(traits.reads_per_segment, 12.0);
  EXPECT_LT(traits.followed, 0.5);
  EXPECT_EQ(choose_method(traits, 0).method, "sar");
  Diagnostics diagnostics;
  const LocalizationResult result =
      find_method(built_in_methods(), "auto").locate(hall.problem, 2, diagnostics);
  EXPECT_EQ(result.method, "sar");
  std::size_t located = 0;
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    ++located;
    const Eigen::Vector3d& p_WT = estimate.candidates.front().p_WT;
    EXPECT_LT((p_WT - hall.truth.at(estimate.tag)).head<2>().norm(), 0.1) << estimate.tag;
  }
  EXPECT_GE(located, 11U);
}

TEST(Automatic, EstimatesThePoseErrorWhereTheCarrierHopsToo) {
  made::Noise noise;
  noise.pose_m = 0.01;
  made::Rng rng(1);
  const made::Path path = made::aisles(0.02);
  made::Hall hall =
      made::hall(path, made::believed(path, noise, made::kPathRate, rng), 8, noise, rng);
  hop(path, hall, rng);
  EXPECT_EQ(choice_for(hall.problem).method, "robust");  // At first.
  Diagnostics diagnostics;
  const LocalizationResult result =
      find_method(built_in_methods(), "auto").locate(hall.problem, 2, diagnostics);
  EXPECT_EQ(result.method, "joint") << result.why;
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    const Candidate& place = estimate.candidates.front();
    EXPECT_LT((place.p_WT - hall.truth.at(estimate.tag)).norm(), 0.1) << estimate.tag;
  }
}

TEST(Automatic, TakesScanWhereMostReadsAreOfShortStraightScansAmidReflections) {
  made::Rng rng(1);
  made::Hall hall = made::hall(made::straight(1.5, 0.02), 6, {}, rng);
  const made::Hall longer = made::hall(made::straight(5.0, 0.02), 1, {}, rng);
  hall.problem.samples["u0"] = longer.problem.samples.at("t0");
  hall.truth["u0"] = longer.truth.at("t0");
  made::reflect(made::walls(0.5), hall);
  double reads = 0.0;
  double reads_of_scans = 0.0;
  for (const auto& [tag, samples] : hall.problem.samples) {
    const auto count = static_cast<double>(samples.at("a").size());
    reads += count;
    reads_of_scans += tag == "u0" ? 0.0 : count;
  }
  const DataTraits traits = traits_of(hall.problem, 1);
  EXPECT_NEAR(traits.short_scans, reads_of_scans / reads, 1e-12);
  EXPECT_GE(traits.unexplained, 0.5);
  EXPECT_LE(traits.unexplained, 1.0);
  EXPECT_EQ(choose_method(traits, 0).method, "scan");
}

TEST(Automatic, GoesBySignalStrengthWhereAntennasStand) {
  made::Hall hall = moving_hall({});
  for (auto& [tag, samples] : hall.problem.samples) {
    for (PhaseSample& sample : samples["a"]) sample.p_WA = {0.0, 0.0, 1.0};
  }
  EXPECT_EQ(choice_for(hall.problem).method, "fixed");
  hall.problem.reference_tags = {
      {"t0", {0, 0, 0}}, {"t1", {1, 0, 0}}, {"t2", {0, 1, 0}}, {"t3", {1, 1, 0}}};
  EXPECT_EQ(choice_for(hall.problem).method, "fixed");
  hall.problem.reference_tags["t4"] = {2, 1, 0};
  EXPECT_EQ(choice_for(hall.problem).method, "landmarc");
  for (auto& [tag, samples] : hall.problem.samples) samples["b"] = samples["c"] = samples["a"];
  EXPECT_EQ(choice_for(hall.problem).method, "fixed");
}

TEST(Automatic, RunsWhatItChoseAndSaysWhy) {
  const made::Hall hall = moving_hall({});
  Diagnostics diagnostics;
  const Method method = find_method(built_in_methods(), "auto");
  const LocalizationResult result = method.locate(hall.problem, 1, diagnostics);
  EXPECT_EQ(result.method, "ml");
  EXPECT_EQ(result.why, "the pose is exact and the phase fits");
  EXPECT_EQ(result.estimates.size(), 4U);
}

TEST(Automatic, TakesTheWorldForKnownUnlessItMustNot) {
  made::Hall hall = moving_hall({});
  const std::vector<Method> methods = built_in_methods();
  const Method automatic = find_method(methods, "auto");
  const Method doubting = configured(automatic, {{"known_world", "false", "x.yaml:1"}});
  const Method asked = configured(automatic, {{"known_world", "true", "x.yaml:1"}});
  Diagnostics silent;
  EXPECT_EQ(automatic.locate(hall.problem, 1, silent).method, "ml");
  EXPECT_TRUE(silent.warnings().empty());
  Diagnostics without;
  EXPECT_EQ(asked.locate(hall.problem, 1, without).method, "ml");
  ASSERT_EQ(without.warnings().size(), 1U);
  EXPECT_NE(without.warnings().front().find("known_world has no effect"), std::string::npos);
  // An empty room: only the direct path.
  hall.problem.trace = [](const std::string& /*tag*/, const Eigen::Vector3d& /*p_WT*/,
                          const std::map<std::string, TracedFrom>& antennas) {
    TracedReplies replies;
    for (const auto& [antenna, from] : antennas) {
      for (const RigidTransform& X_WA : from.X_WA) {
        replies[antenna].push_back({{{X_WA.translation, 1.0, Eigen::Vector3d::UnitX(), true}}, {}});
      }
    }
    return replies;
  };
  Diagnostics diagnostics;
  EXPECT_EQ(doubting.locate(hall.problem, 1, diagnostics).method, "ml");
  const LocalizationResult through = automatic.locate(hall.problem, 1, diagnostics);
  EXPECT_EQ(through.method, "multipath");
  EXPECT_NE(through.why.find("the world is known"), std::string::npos) << through.why;
  for (const TagEstimate& estimate : through.estimates) {
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << estimate.reason;
    const Eigen::Vector3d off = estimate.candidates.front().p_WT - hall.truth.at(estimate.tag);
    EXPECT_LT(off.norm(), 0.02) << estimate.tag;
  }
  // Wheels that drift by ten micrometres from pose to pose do no harm, by a centimetre they do.
  for (const double step_m : {1e-5, 0.01}) {
    for (const auto& [antenna, track] : hall.problem.tracks) {
      std::vector<Drift> drift;
      for (const StampedPose& pose : track.X_WA) {
        drift.push_back({pose.stamp, pose.X_WB.translation.head<2>()});
        drift.back().since_last(0, 0) = step_m * step_m;
        drift.back().since_last(1, 1) = step_m * step_m;
      }
      hall.problem.drift[antenna] = drift;
    }
    Diagnostics of_drift;
    const bool is_through = automatic.locate(hall.problem, 1, of_drift).method == "multipath";
    EXPECT_EQ(is_through, step_m < 1e-3);
    const std::string warnings = fmt::format("{}", fmt::join(of_drift.warnings(), "\n"));
    EXPECT_EQ(warnings.find("reflections are not traced") == std::string::npos, is_through);
  }
}

TEST(Automatic, TakesNothingAtAll) {
  Diagnostics diagnostics;
  const Method method = find_method(built_in_methods(), "auto");
  EXPECT_TRUE(method.locate({}, 1, diagnostics).estimates.empty());
}

}  // namespace
}  // namespace tagfield
