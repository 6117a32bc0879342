// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/phase_jumps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "tagfield/base/units.h"
#include "tagfield/localization/test/made_survey.h"

namespace tagfield {
namespace {

using made::Rng;
using made::Survey;
using made::SurveyPlan;

/// The reader restarts after `after_s` seconds.
struct Restart {
  double after_s = 0.0;
  double step_rad = 0.0;
  std::vector<std::string> antennas{};  ///< Those that are affected; all if empty.
};

Time stamp_of(const Restart& restart) {
  return time_from_seconds(made::ReaderSetup{}.start_s + restart.after_s);
}

void apply(const Restart& restart, Survey& survey) {
  const auto& some = restart.antennas;
  for (TagRead& read : survey.reads) {
    const bool is_one = some.empty() || std::count(some.begin(), some.end(), read.antenna) > 0;
    if (!is_one || read.stamp <= stamp_of(restart)) continue;
    read.phase_rad = wrap_to_two_pi(read.phase_rad + restart.step_rad);
  }
}

SamplesByTag samples_of(const Survey& survey) {
  Diagnostics diagnostics;
  return join_reads_with_tracks(survey.reads, tracks_of(survey.poses, diagnostics), 0.5,
                                diagnostics);
}

std::vector<PhaseJump> jumps_in(const Survey& survey) {
  return find_phase_jumps(samples_of(survey));
}

/// A step of either sign and at least `least`.
Restart any_restart(double least, Rng& rng) {
  return {made::uniform(rng, 4.0, 12.0), made::uniform(rng, least, kTwoPi - least)};
}

bool is_at(const PhaseJump& jump, const Restart& restart) {
  return jump.last_before <= stamp_of(restart) && stamp_of(restart) < jump.first_after;
}

/// Six tags near enough to be read over the whole path.
SurveyPlan dense_plan() {
  SurveyPlan plan;
  plan.tags = 6;
  plan.range_m = 8.0;
  return plan;
}

/// Two antennas on a body, or as many channels, errors and lost replies as may be.
std::vector<SurveyPlan> plans_of_all_kinds() {
  std::vector<SurveyPlan> plans(6, dense_plan());
  plans[1].antennas = {{"a", {0.2, 0.0, 0.0}}, {"b", {-0.2, 0.2, 0.1}}};
  plans[2].channels = 4;
  plans[2].dwell = 30;
  plans[3].pose_m = 0.02;
  plans[4].lost = 0.0;
  plans[4].path = made::s_curve(7.0, 0.02);
  plans[5].phase_noise_rad = 0.2;
  plans[5].tags = 12;
  return plans;
}

TEST(PhaseJumps, AreFoundBetweenTheRightReads) {
  int restarts = 0;
  int found = 0;
  for (const SurveyPlan& plan : plans_of_all_kinds()) {
    for (unsigned seed = 1; seed <= 10; ++seed) {
      Rng rng(seed);
      Survey survey = make_survey(plan, rng);
      const Restart restart = any_restart(1.2, rng);
      apply(restart, survey);
      restarts += static_cast<int>(plan.antennas.size());
      for (const PhaseJump& jump : jumps_in(survey)) {
        ++found;
        EXPECT_TRUE(is_at(jump, restart)) << jump.antenna << " " << seed;
        ASSERT_TRUE(jump.step_rad);
        // Six tags and a noise of 0.3 rad for each, but for what a few reads tell.
        EXPECT_NEAR(wrap_to_pi(*jump.step_rad - restart.step_rad), 0.0, 0.45) << seed;
      }
    }
  }
  EXPECT_GE(10 * found, 9 * restarts) << found << " of " << restarts;
}

TEST(PhaseJumps, AreNotFoundWhereThereAreNone) {
  std::vector<SurveyPlan> plans = plans_of_all_kinds();
  plans.resize(12, dense_plan());
  plans[6].strays = 0.1;
  plans[7].strays = 0.3;
  plans[8].latency_s = 0.3;
  plans[9].mirrors = made::walls(0.5);
  plans[10].velocity = {0.05, 0.1, 0.0};
  plans[11].pi_ambiguity = true;
  for (std::size_t i = 0; i < plans.size(); ++i) {
    for (unsigned seed = 1; seed <= 20; ++seed) {
      Rng rng(seed);
      EXPECT_TRUE(jumps_in(make_survey(plans[i], rng)).empty()) << i << " " << seed;
    }
  }
}

/// Believed poses that a filter corrects by `step` at once after `after_s` seconds.
void correct_poses(double after_s, const Eigen::Vector3d& step, Survey& survey) {
  for (AntennaPose& pose : survey.poses) {
    if (pose.stamp > stamp_of({after_s})) pose.X_WA.translation += step;
  }
}

TEST(PhaseJumps, AreNotThoseOfPoses) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    Survey survey = make_survey(dense_plan(), rng);
    const double size = made::uniform(rng, 0.01, 0.2);
    const double angle = made::uniform(rng, 0.0, kTwoPi);
    correct_poses(8.0, size * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0), survey);
    EXPECT_TRUE(jumps_in(survey).empty()) << seed << ": " << size;
  }
}

/// Tags whose phases jump by amounts of their own, as if they were moved between two reads.
TEST(PhaseJumps, AreNotThoseOfSingleTags) {
  for (unsigned seed = 1; seed <= 40; ++seed) {
    Rng rng(seed);
    Survey survey = make_survey(dense_plan(), rng);
    const double both = made::uniform(rng, 1.0, 5.0);
    for (TagRead& read : survey.reads) {
      const bool moves = read.tag == "tag1" || read.tag == "tag2";
      if (moves && read.stamp > stamp_of({8.0})) {
        read.phase_rad = wrap_to_two_pi(read.phase_rad + both);
      }
    }
    EXPECT_TRUE(jumps_in(survey).empty()) << seed;
  }
}

TEST(PhaseJumps, AreThoseOfTheAntennasThatJump) {
  SurveyPlan plan = dense_plan();
  plan.antennas = {{"a", {0.2, 0.0, 0.0}}, {"b", {-0.2, 0.2, 0.1}}};
  int found = 0;
  for (unsigned seed = 1; seed <= 10; ++seed) {
    Rng rng(seed);
    Survey survey = make_survey(plan, rng);
    Restart restart = any_restart(1.2, rng);
    restart.antennas = {"b"};
    apply(restart, survey);
    for (const PhaseJump& jump : jumps_in(survey)) {
      EXPECT_EQ(jump.antenna, "b") << seed;
      ++found;
    }
  }
  EXPECT_GE(found, 9);
}

TEST(PhaseJumps, OfAntennasThatReadLittleAreSharedWithOthers) {
  SurveyPlan plan = dense_plan();
  plan.antennas = {{"a", {0.2, 0.0, 0.0}}, {"b", {-0.2, 0.2, 0.1}}};
  Rng rng(1);
  Survey survey = make_survey(plan, rng);
  const Restart restart{8.0, 2.0};
  apply(restart, survey);
  // Antenna b reads a single tag.
  auto& reads = survey.reads;
  reads.erase(std::remove_if(reads.begin(), reads.end(),
                             [](const TagRead& r) { return r.antenna == "b" && r.tag != "tag1"; }),
              reads.end());
  const std::vector<PhaseJump> jumps = jumps_in(survey);
  ASSERT_EQ(jumps.size(), 2U);
  EXPECT_EQ(jumps[0].antenna, "a");
  EXPECT_EQ(jumps[1].antenna, "b");
  EXPECT_TRUE(is_at(jumps[1], restart));
}

TEST(PhaseJumps, SeparateTheOffsetsBeforeAndAfter) {
  Rng rng(1);
  Survey survey = make_survey(dense_plan(), rng);
  const Restart restart{8.0, 2.0};
  apply(restart, survey);
  survey.known.offsets = {{"a", std::nullopt, survey.offsets_rad.at("a")}};
  Diagnostics diagnostics;
  const LocalizationProblem problem =
      make_problem(survey.reads, survey.poses, survey.known, diagnostics);
  EXPECT_TRUE(problem.offset_known.empty());
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  const std::string& warning = diagnostics.warnings().front();
  EXPECT_NE(warning.find("antenna 'a' jumps by "), std::string::npos) << warning;
  EXPECT_NE(warning.find("known offset"), std::string::npos) << warning;
  for (const auto& [tag, of_tag] : problem.samples) {
    for (const PhaseSample& sample : of_tag.at("a")) {
      const double off_hz = sample.frequency_hz - 865.7e6;
      EXPECT_EQ(off_hz > 0.0, sample.stamp > stamp_of(restart));
      EXPECT_LT(off_hz / 865.7e6, 1e-11);
    }
  }
}

/// Located tags that are over three expected errors and 5 cm off, of how many.
struct Claims {
  int located = 0;
  int wrong = 0;
};

void count(const Survey& survey, const LocalizationResult& result, Claims& claims) {
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    const Candidate& claim = estimate.candidates.front();
    const double off = (claim.p_WT - survey.truth.at(estimate.tag)).head<2>().norm();
    ++claims.located;
    if (off > std::max(3.0 * claim.expected_error_m, 0.05)) ++claims.wrong;
  }
}

LocalizationResult located(const Survey& survey, const std::string& method, bool as_one_channel) {
  Diagnostics diagnostics;
  LocalizationProblem problem = make_problem(survey.reads, survey.poses, survey.known, diagnostics);
  for (auto& [tag, of_tag] : problem.samples) {
    for (PhaseSample& sample : of_tag.at("a")) {
      if (as_one_channel) sample.frequency_hz = 865.7e6;
    }
  }
  return locate_problem(find_method(built_in_methods(), method), problem, 2, diagnostics);
}

/// Without a restart; with one, but all reads taken for one channel; and divided there.
struct Comparison {
  Claims whole, as_one, divided;
};

Comparison compared(const SurveyPlan& plan, const std::string& method) {
  Comparison of;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    Rng rng(seed);
    Survey survey = make_survey(plan, rng);
    count(survey, located(survey, method, false), of.whole);
    apply(any_restart(1.2, rng), survey);
    count(survey, located(survey, method, true), of.as_one);
    count(survey, located(survey, method, false), of.divided);
  }
  return of;
}

TEST(PhaseJumps, DoNotKeepTagsFromBeingLocated) {
  for (const std::string method : {"joint", "ml", "sar"}) {
    const Comparison of = compared(dense_plan(), method);
    EXPECT_LT(10 * of.as_one.located, 8 * of.whole.located) << method;
    EXPECT_GE(10 * of.divided.located, 9 * of.whole.located) << method;
    EXPECT_EQ(of.divided.wrong, 0) << method;
  }
}

}  // namespace
}  // namespace tagfield
