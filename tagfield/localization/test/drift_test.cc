// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/drift.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

constexpr double kSigma_m = 0.005;

/// An antenna that drives 10 m along x in 10 s, a read each second, and drifts sideways and turns.
LocalizationProblem problem_of_a_drive() {
  LocalizationProblem problem;
  for (int second = 0; second <= 10; ++second) {
    const Time stamp = time_from_seconds(second);
    PhaseSample sample;
    sample.stamp = stamp;
    sample.p_WA = {static_cast<double>(second), 0.0, 1.0};
    problem.samples["tag"]["antenna"].push_back(sample);
    Drift drift;
    drift.stamp = stamp;
    drift.origin_W = sample.p_WA.head<2>();
    drift.since_start(1, 1) = 1e-4 * second;  // 1 cm after a second
    drift.since_start(2, 2) = 1e-6 * second;  // 1 mrad
    problem.drift["antenna"].push_back(drift);
  }
  return problem;
}

LocalizationResult located_at(const Eigen::Vector3d& place) {
  Candidate candidate;
  candidate.p_WT = place;
  candidate.expected_error_m = std::sqrt(2.0) * kSigma_m;
  candidate.covariance = Eigen::Matrix3d::Zero();
  candidate.covariance->topLeftCorner<2, 2>().diagonal().setConstant(kSigma_m * kSigma_m);
  LocalizationResult result;
  result.method = "ml";
  result.estimates = {{"tag", Verdict::kLocated, "", {candidate}, 11}};
  return result;
}

TEST(Drift, IsThatOfThePoseClosestToThePosition) {
  const LocalizationProblem problem = problem_of_a_drive();
  LocalizationResult result = located_at({4.2, 3.0, 1.0});
  add_drift(problem, result);
  const Candidate& best = result.estimates.front().candidates.front();
  // After 4 s: 4 cm² sideways; a turn of 2 mrad about (4, 0) moves (4.2, 3) by 6 mm along x and
  // 0.4 mm along y.
  const double own = kSigma_m * kSigma_m;
  EXPECT_NEAR((*best.covariance)(0, 0), own + 4e-6 * 9.0, 1e-12);
  EXPECT_NEAR((*best.covariance)(1, 1), own + 4e-4 + 4e-6 * 0.04, 1e-12);
  EXPECT_NEAR((*best.covariance)(0, 1), -4e-6 * 3.0 * 0.2, 1e-12);
  EXPECT_NEAR(best.expected_error_m, std::sqrt(best.covariance->topLeftCorner<2, 2>().trace()),
              1e-12);
  EXPECT_EQ(result.estimates.front().verdict, Verdict::kLocated);
}

TEST(Drift, APositionThatIsNoLongerSureEnoughIsNotLocated) {
  LocalizationProblem problem = problem_of_a_drive();
  problem.drift["antenna"].back().since_start(1, 1) = 0.04;
  LocalizationResult near = located_at({9.0, 1.0, 1.0});
  LocalizationResult far = located_at({10.0, 1.0, 1.0});
  add_drift(problem, near);
  add_drift(problem, far);
  EXPECT_EQ(near.estimates.front().verdict, Verdict::kLocated);
  EXPECT_EQ(far.estimates.front().verdict, Verdict::kNotLocated);
  EXPECT_EQ(
      far.estimates.front().reason,
      "cannot localize: the drift of the wheels, which joint estimates, leaves it uncertain by "
      "0.20 m, limit 0.15 m");
}

TEST(Drift, TagsReadByAntennasAtRestAndReferenceTagsHaveNone) {
  LocalizationProblem problem = problem_of_a_drive();
  problem.samples["other"]["at_rest"] = problem.samples["tag"]["antenna"];
  LocalizationResult result = located_at({4.0, 3.0, 1.0});
  result.estimates.front().tag = "other";
  add_drift(problem, result);
  EXPECT_EQ(result.estimates.front().candidates.front().expected_error_m,
            std::sqrt(2.0) * kSigma_m);
  result = located_at({4.0, 3.0, 1.0});
  problem.reference_tags["tag"] = {4.0, 3.0, 1.0};
  add_drift(problem, result);
  EXPECT_EQ(result.estimates.front().candidates.front().expected_error_m,
            std::sqrt(2.0) * kSigma_m);
}

/// A drive of 10 m along x whose heading is a random walk of `rate` [rad²/m]; 21 reads.
LocalizationProblem problem_of_a_turning_drive(double rate) {
  constexpr int kSteps = 2000;
  LocalizationProblem problem;
  for (int i = 0; i <= kSteps; ++i) {
    const double s = 10.0 * i / kSteps;
    Drift drift;
    drift.stamp = time_from_seconds(s);
    drift.origin_W = {s, 0.0};
    drift.since_last(2, 2) = i == 0 ? 0.0 : rate * 10.0 / kSteps;
    problem.drift["antenna"].push_back(drift);
    if (i % 100 != 0) continue;
    PhaseSample sample;
    sample.stamp = drift.stamp;
    sample.frequency_hz = 9e8;
    sample.p_WA = {s, 0.0, 1.0};
    problem.samples["tag"]["antenna"].push_back(sample);
  }
  return problem;
}

// A random walk of the heading of variance q s leaves q s³/3 across after the way s.
TEST(Drift, WhileATagIsReadIsThatFromTheMiddleOfItsReads) {
  constexpr double kRate = 1e-4;
  double mean = 0.0;
  for (int i = -10; i <= 10; ++i) mean += kRate * std::pow(std::abs(0.5 * i), 3.0) / 3.0 / 21.0;
  const LocalizationProblem problem = problem_of_a_turning_drive(kRate);
  EXPECT_NEAR(drift_while_read(problem, "tag"), std::sqrt(0.5 * mean), 1e-3 * std::sqrt(mean));
  EXPECT_EQ(usual_drift_while_read(problem), drift_while_read(problem, "tag"));
  EXPECT_EQ(drift_while_read(problem, "another"), 0.0);
}

TEST(Drift, OverHalfAWavelengthWhileATagIsReadRefusesAllTags) {
  const double unit = drift_while_read(problem_of_a_turning_drive(1.0), "tag");
  const auto refused = [&](double drift_m, const char* method, bool has_reference) {
    LocalizationProblem problem = problem_of_a_turning_drive(std::pow(drift_m / unit, 2.0));
    if (has_reference) problem.reference_tags["other"] = {0.0, 0.0, 1.0};
    LocalizationResult result = located_at({4.0, 3.0, 1.0});
    result.method = method;
    Diagnostics diagnostics;
    refuse_drifting(problem, result, diagnostics);
    const bool is_refused = result.estimates.front().verdict == Verdict::kNotLocated;
    EXPECT_EQ(diagnostics.warnings().size(), is_refused ? 1U : 0U);
    return is_refused;
  };
  EXPECT_FALSE(refused(0.16, "joint", false));  // Half a wavelength is 0.167 m.
  EXPECT_TRUE(refused(0.17, "joint", false));
  EXPECT_FALSE(refused(0.17, "joint", true));
  EXPECT_TRUE(refused(0.17, "hyperbola", true));
}

TEST(Drift, IsMadeOfThePosesUnlessTheirErrorIsStated) {
  std::vector<AntennaPose> poses;
  for (int second = 0; second <= 2; ++second) {
    AntennaPose pose;
    pose.stamp = time_from_seconds(second);
    pose.antenna = "antenna";
    pose.X_WA = from_translation({static_cast<double>(second), 0.0, 1.0});
    poses.push_back(pose);
  }
  KnownBeforehand known;
  known.drift = [](const std::string& antenna, const Trajectory& X_WA) {
    EXPECT_EQ(antenna, "antenna");
    return std::vector<Drift>(X_WA.size());
  };
  Diagnostics diagnostics;
  const std::vector<TagRead> none;
  EXPECT_EQ(make_problem(none, poses, known, diagnostics).drift.at("antenna").size(), 3U);
  known.pose_error.emplace();
  EXPECT_TRUE(make_problem(none, poses, known, diagnostics).drift.empty());
}

}  // namespace
}  // namespace tagfield
