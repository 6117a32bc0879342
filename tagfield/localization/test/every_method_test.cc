// SPDX-License-Identifier: Apache-2.0
/// Tests of what holds for every method that comes with Tagfield.

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include "method_study.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/locate.h"

namespace tagfield {
namespace {

using namespace made;

const std::vector<Method>& methods() {
  static const std::vector<Method> all = built_in_methods();
  return all;
}

bool is_finite(const TagEstimate& estimate) {
  return std::all_of(
      estimate.candidates.begin(), estimate.candidates.end(), [](const Candidate& c) {
        return c.p_WT.allFinite() && std::isfinite(c.rms_m) && std::isfinite(c.expected_error_m) &&
               (!c.covariance || c.covariance->allFinite());
      });
}

/// Sets RSSI as of an isotropic tag, in whole dB.
void give_rssi(const Eigen::Vector3d& p_WT, std::vector<PhaseSample>& samples) {
  for (PhaseSample& s : samples) {
    s.rssi_dbm = std::round(-30.0 - 40.0 * std::log10((p_WT - s.p_WA).norm()));
  }
}

/// Sets the track of each antenna from its samples, with one position per stamp.
void give_tracks(LocalizationProblem& problem) {
  std::map<std::string, std::map<Time, Eigen::Vector3d>> places;
  for (const auto& [tag, of_tag] : problem.samples) {
    for (const auto& [antenna, samples] : of_tag) {
      for (const PhaseSample& s : samples) places[antenna].emplace(s.stamp, s.p_WA);
    }
  }
  for (const auto& [antenna, of_antenna] : places) {
    for (const auto& [stamp, p_WA] : of_antenna) {
      problem.tracks[antenna].X_WA.push_back({stamp, from_translation(p_WA)});
    }
  }
}

/// Several tags, some of them unusual, and one reference tag.
LocalizationProblem mixed_problem() {
  Rng rng(77);
  const Path path = aisles(0.04);
  LocalizationProblem problem;
  problem.heights.of_all = 0.4;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d p_WT = beside(path, 2.0, 0.4, rng);
    const std::string tag = "tag" + std::to_string(k);
    auto samples = read_along(path, p_WT, Noise{}, rng);
    give_rssi(p_WT, samples);
    problem.samples[tag]["a"] = std::move(samples);
    if (k == 0) problem.reference_tags[tag] = p_WT;
  }
  problem.samples["empty"] = {};
  problem.samples["no reads"]["a"] = {};
  problem.samples["one"]["a"] = {problem.samples["tag1"]["a"].front()};
  problem.samples["still"]["s"] = read_along(Path(50, {1, 1, 0.4}), {3, 2, 0.4}, Noise{}, rng);
  problem.samples["collinear"]["b"] =
      read_along(straight(8.0, 0.04), {3.0, 2.0, 0.4}, Noise{}, rng);
  problem.samples["on the path"]["c"] =
      read_along(straight(8.0, 0.04), {3.0, 0.0, 0.4}, Noise{}, rng);
  const Path far = straight(90.0, 0.5);
  problem.samples["far path"]["d"] =
      read_along(far, far, {45.0, 1.0, 0.4}, Noise{}, rng, {865.7e6, 15.0, 1000.0, 1.7e9});
  give_tracks(problem);
  return problem;
}

TEST(EveryMethod, AnswersForEachTagInOrderWithoutInfinities) {
  const LocalizationProblem problem = mixed_problem();
  for (const Method& method : methods()) {
    Diagnostics diagnostics;
    const LocalizationResult result = method.locate(problem, 1, diagnostics);
    EXPECT_EQ(result.estimates.size(), problem.samples.size()) << method.name;
    auto tag = problem.samples.begin();
    for (const TagEstimate& estimate : result.estimates) {
      EXPECT_EQ(estimate.tag, tag->first) << method.name;
      EXPECT_TRUE(is_finite(estimate)) << method.name << ": " << estimate.tag;
      EXPECT_EQ(estimate.candidates.empty(), estimate.verdict == Verdict::kNotLocated);
      EXPECT_EQ(estimate.reason.empty(), estimate.verdict == Verdict::kLocated &&
                                             problem.reference_tags.count(estimate.tag) == 0)
          << method.name << ": " << estimate.tag;
      ++tag;
    }
  }
}

/// The mixed problem with the input of one key of a scenario's `localization` changed.
LocalizationProblem changed_problem(const std::string& key) {
  LocalizationProblem problem = mixed_problem();
  if (key == "offset") problem.offset_known = {"a", "b", "c", "d", "s"};
  if (key == "pose_error") problem.pose_error = PoseErrorModel{0.1, 0.1, 2.0};
  if (key == "max_expected_error_m") problem.limits.max_expected_error_m = 1e-6;
  if (key == "max_rms_m") problem.limits.max_rms_m = 1e-6;
  if (key != "pi_ambiguity") return problem;
  problem.pi_ambiguity = true;
  for (auto& [tag, of_tag] : problem.samples) {
    for (auto& [antenna, samples] : of_tag) {
      for (PhaseSample& s : samples) {
        s.phase_rad = std::fmod(2.0 * s.phase_rad, kTwoPi);
        s.frequency_hz *= 2.0;
      }
    }
  }
  return problem;
}

/// The method's complete result as text.
std::string result_text(const Method& method, const LocalizationProblem& problem) {
  Diagnostics diagnostics;
  std::string text;
  for (const TagEstimate& estimate : method.locate(problem, 1, diagnostics).estimates) {
    text += fmt::format("{} {} {}\n", estimate.tag, static_cast<int>(estimate.verdict),
                        estimate.reason);
    for (const Candidate& c : estimate.candidates) {
      text += fmt::format("{} {} {} {}\n", c.p_WT.x(), c.p_WT.y(), c.p_WT.z(), c.expected_error_m);
    }
  }
  return text;
}

TEST(EveryMethod, FindsTheSameWhateverIsKnownOfWhatItIgnores) {
  std::map<std::string, int> uses;
  const LocalizationProblem problem = mixed_problem();
  for (const Method& method : methods()) {
    if (method.name == "auto") continue;  // It ignores what the chosen method ignores.
    const std::string usual = result_text(method, problem);
    for (const char* const key :
         {"offset", "pi_ambiguity", "pose_error", "max_expected_error_m", "max_rms_m"}) {
      const std::string other = result_text(method, changed_problem(key));
      if (all_ignore({method}, key)) {
        EXPECT_EQ(other, usual) << method.name << ": " << key;
      } else {
        uses[key] += static_cast<int>(other != usual);
      }
    }
  }
  // Each change must affect the result of at least two methods, otherwise it tests nothing.
  for (const auto& [key, count] : uses) EXPECT_GE(count, 2) << key;
}

TEST(EveryMethod, ReferenceTagsAreWhereTheyAre) {
  const LocalizationProblem problem = mixed_problem();
  for (const Method& method : methods()) {
    Diagnostics diagnostics;
    const LocalizationResult result = method.locate(problem, 1, diagnostics);
    for (const TagEstimate& estimate : result.estimates) {
      if (estimate.tag != "tag0") continue;
      ASSERT_EQ(estimate.candidates.size(), 1u) << method.name << ": " << estimate.reason;
      EXPECT_EQ(estimate.candidates.at(0).p_WT, problem.reference_tags.at("tag0")) << method.name;
    }
  }
}

TEST(EveryMethod, SaysTheSameOnAnyNumberOfThreads) {
  const LocalizationProblem problem = mixed_problem();
  for (const Method& method : methods()) {
    Diagnostics diagnostics;
    const auto one = method.locate(problem, 1, diagnostics).estimates;
    const auto four = method.locate(problem, 4, diagnostics).estimates;
    ASSERT_EQ(one.size(), four.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].verdict, four[i].verdict) << method.name;
      EXPECT_EQ(one[i].reason, four[i].reason) << method.name;
      ASSERT_EQ(one[i].candidates.size(), four[i].candidates.size()) << method.name;
      for (std::size_t k = 0; k < one[i].candidates.size(); ++k) {
        EXPECT_EQ(one[i].candidates[k].p_WT, four[i].candidates[k].p_WT) << method.name;
      }
    }
  }
}

/// For arbitrary reads: random positions, random phases.
RC_GTEST_PROP(EveryMethod, NothingMakesAMethodThrowOrGiveWhatIsNotANumber, ()) {
  Rng rng(*rc::gen::arbitrary<std::uint32_t>());
  const int count = *rc::gen::inRange(0, 60);
  const double size = *rc::gen::element(0.0, 0.3, 3.0, 60.0);
  LocalizationProblem problem;
  problem.heights.of_all = 0.5;
  std::vector<PhaseSample>& samples = problem.samples["t"]["a"];
  for (int i = 0; i < count; ++i) {
    PhaseSample sample;
    sample.stamp = time_from_seconds(1.7e9 + 0.05 * i);
    sample.phase_rad = uniform(rng, 0.0, kTwoPi);
    sample.frequency_hz = i % 3 == 0 ? 866.3e6 : 865.7e6;
    sample.p_WA = {uniform(rng, -size, size), uniform(rng, -size, size), 0.5};
    sample.rssi_dbm = i % 5 == 0 ? kNoRssi : std::round(uniform(rng, -75.0, -35.0));
    samples.push_back(sample);
  }
  give_tracks(problem);
  for (const Method& method : methods()) RC_ASSERT(is_finite(locate_one(method, problem)));
}

}  // namespace
}  // namespace tagfield
