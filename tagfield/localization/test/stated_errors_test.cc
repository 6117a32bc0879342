// SPDX-License-Identifier: Apache-2.0
/// Whether positions and stated errors are right on surveys of many kinds (made_survey.h), also
/// where poses, phases or surroundings are not as a method takes them to be.

#include <gtest/gtest.h>

#include <functional>
#include <string>
#include <vector>

#include "survey_claims.h"

namespace tagfield {
namespace {

using namespace made;

using Change = std::function<void(Survey&)>;

/// Over surveys with the seeds 1 to `seeds`.
Claims claims_of(const std::string& method, const SurveyPlan& plan, unsigned seeds,
                 const Change& change = {}) {
  Claims claims;
  for (unsigned seed = 1; seed <= seeds; ++seed) {
    Rng rng(seed);
    Survey survey = make_survey(plan, rng);
    if (change) change(survey);
    add_claims(method, survey, claims);
  }
  return claims;
}

void state_no_pose_error(Survey& survey) { survey.known.pose_error.reset(); }

/// Poses are off by a centimetre and taken for exact.
TEST(StatedErrors, HoldWherePosesAreTakenForExact) {
  const SurveyPlan plan = {.tags = 6, .pose_m = 0.01};
  for (const std::string& method : std::vector<std::string>{"least_squares", "ml", "sar"}) {
    const Claims claims = claims_of(method, plan, 10, state_no_pose_error);
    EXPECT_GE(claims.located, 50) << method;  // Of 60.
    EXPECT_LT(claims.calibration(), 1.5) << method;
    EXPECT_EQ(claims.false_ones, 0) << method;
  }
}

TEST(StatedErrors, HoldAmidReflections) {
  const SurveyPlan plan = {.mirrors = walls(0.4)};
  for (const std::string& method : std::vector<std::string>{"least_squares", "ml", "joint"}) {
    const Claims claims = claims_of(method, plan, 12);
    EXPECT_GE(claims.located, 30) << method;  // Of 48.
    EXPECT_LT(claims.calibration(), 2.0) << method;
    EXPECT_EQ(claims.false_ones, 0) << method;
  }
}

TEST(StatedErrors, AreNoLargerWithoutAnyOfThat) {
  for (const std::string& method :
       std::vector<std::string>{"least_squares", "ml", "joint", "sar"}) {
    const Claims claims = claims_of(method, {}, 10);
    EXPECT_EQ(claims.located, 40) << method;
    EXPECT_GT(claims.calibration(), 0.6) << method;
    EXPECT_LT(claims.calibration(), 1.4) << method;
  }
}

/// A reader on a few channels, one read in twelve with any phase.
TEST(StatedErrors, HoldWithStrayPhases) {
  const SurveyPlan plan = {.path = l_turn(3.0, 2.5, 0.025),
                           .channels = 3,
                           .dwell = 15,
                           .phase_noise_rad = 0.07,
                           .strays = 0.08};
  for (const std::string& method : std::vector<std::string>{"least_squares", "ml", "joint"}) {
    const Claims claims = claims_of(method, plan, 12);
    EXPECT_GE(claims.located, 24) << method;  // Of 48.
    EXPECT_EQ(claims.false_ones, 0) << method;
  }
}

/// Only errors of the poses tell the sides of a straight path apart, and they do so wrongly in half
/// of the cases; RSSI of antennas without a front says nothing.
TEST(StraightPath, NoSideIsClaimedForPoseErrors) {
  const SurveyPlan plan = {.path = straight(6.0, 0.03, 0.4),
                           .antennas = {{"a", {0.0, 0.0, 0.0}, 0.0}},
                           .channels = 3,
                           .dwell = 8,
                           .pose_m = 0.015};
  for (const std::string& method :
       std::vector<std::string>{"sar", "robust", "dah", "particle", "joint"}) {
    const Claims claims = claims_of(method, plan, 8);
    EXPECT_EQ(claims.false_ones, 0) << method;
    EXPECT_EQ(claims.ambiguous_with_truth, claims.ambiguous) << method;
    EXPECT_LE(claims.located, claims.tags / 10) << method;
  }
}

/// Two antennas at different heights on a straight path: the same across the plane of their
/// positions.
TEST(StraightPath, NoSideOfThePlaneOfTwoAntennasIsClaimedForPoseErrors) {
  const SurveyPlan plan = {
      .path = straight(6.0, 0.03, 0.4),
      .antennas = {{"left", {0.1, 0.2, 0.0}, kPi / 2.0}, {"right", {0.1, -0.2, 0.3}, -kPi / 2.0}},
      .nearest_m = 1.5,
      .lowest_m = 0.5,
      .highest_m = 2.0,
      .pose_m = 0.015};
  for (const std::string& method : std::vector<std::string>{"sar", "robust", "joint"}) {
    EXPECT_EQ(claims_of(method, plan, 12).false_ones, 0) << method;
  }
}

TEST(StraightPath, TurnsTellTheSidesApart) {
  const SurveyPlan plan = {.pose_m = 0.015};
  for (const std::string& method : std::vector<std::string>{"sar", "robust"}) {
    const Claims claims = claims_of(method, plan, 8);
    EXPECT_GE(claims.located, 24) << method;  // Of 32.
    EXPECT_EQ(claims.false_ones, 0) << method;
  }
}

/// With two antennas at several heights the likelihood has peaks of millimetres in all directions.
TEST(StatedErrors, HoldForHeightsByTwoAntennas) {
  const SurveyPlan plan = {
      .path = rectangle(1.5, 1.0, 8.0, 0.02),
      .antennas = {{"left", {0.1, 0.2, 0.0}, kPi / 2.0}, {"right", {0.1, -0.2, 0.3}, -kPi / 2.0}},
      .nearest_m = 1.5,
      .lowest_m = 0.8,
      .highest_m = 2.0};
  const Claims claims = claims_of("robust", plan, 12);
  EXPECT_GE(claims.located, 36);  // Of 48.
  EXPECT_EQ(claims.false_ones, 0);
}

/// A method of one's own that puts every tag 1 m below or above the antennas.
Method placing(double z) {
  Method method;
  method.name = "placing";
  method.summary = "places tags";
  method.locate = [z](const LocalizationProblem& problem, int, Diagnostics&) {
    LocalizationResult result;
    result.method = "placing";
    for (const auto& [tag, samples] : problem.samples) {
      TagEstimate estimate;
      estimate.tag = tag;
      estimate.verdict = Verdict::kLocated;
      estimate.candidates = {{Eigen::Vector3d(1.0, 2.0, z), 0.001, 0.01}};
      result.estimates.push_back(estimate);
    }
    return result;
  };
  return method;
}

TEST(HeightSide, PositionsOnTheOtherSideOfTheAntennasAreRefused) {
  Rng rng(1);
  Survey survey = make_survey({.lowest_m = 0.5, .highest_m = 1.0}, rng);
  for (const bool above : {true, false}) {
    survey.known.heights.estimated = above ? HeightSide::kAbove : HeightSide::kBelow;
    for (const double z : {-0.6, 1.4}) {
      LocalizationOptions options;
      options.method = "placing";
      options.known = survey.known;
      options.methods = {placing(z)};
      Diagnostics diagnostics;
      const bool is_right = above == (z > 0.4);
      for (const TagEstimate& estimate :
           locate_tags(survey.reads, survey.poses, options, diagnostics).estimates) {
        const std::string why = std::string("cannot localize: no position ") +
                                (above ? "above" : "below") + " the antennas explains the reads";
        EXPECT_EQ(estimate.reason == why, !is_right) << estimate.reason;
      }
    }
  }
}

}  // namespace
}  // namespace tagfield
