// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/joint.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
#include <numeric>

#include "tagfield/localization/bound.h"
#include "tagfield/localization/phase_curves/maximum_likelihood.h"
#include "tagfield/localization/test/problem_of.h"

namespace tagfield {
namespace {

struct Errors {
  std::vector<double> all;
  double nees = 0.0;  ///< Sum over all.
  std::size_t not_located = 0;

  [[nodiscard]] double mean() const {
    return std::accumulate(all.begin(), all.end(), 0.0) / static_cast<double>(all.size());
  }
};

void add(const made::Hall& hall, const LocalizationResult& result, Errors& errors) {
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) {
      ++errors.not_located;
      continue;
    }
    const Candidate& best = estimate.candidates.front();
    const Eigen::Vector2d error = (best.p_WT - hall.truth.at(estimate.tag)).head<2>();
    errors.all.push_back(error.norm());
    const Eigen::Matrix2d covariance = best.covariance->topLeftCorner<2, 2>();
    errors.nees += error.dot(covariance.inverse() * error);
  }
}

LocalizationResult run(const Method& method, const LocalizationProblem& problem) {
  Diagnostics diagnostics;
  return method.locate(problem, 2, diagnostics);
}

/// Mean error at the bound, over all tags.
double bound_of(const made::Hall& hall, const made::Path& path, double phase_noise) {
  BoundInput input;
  input.truth = hall.problem;
  input.truth.tracks["a"] = made::track_along(path);
  for (auto& [tag, samples] : input.truth.samples) {
    for (PhaseSample& sample : samples["a"]) {
      sample.p_WA = held_position_at(input.truth.tracks["a"].X_WA, sample.stamp);
    }
  }
  input.places = hall.truth;
  input.phase_noise_rad["a"] = phase_noise;
  const Bounds bounds = joint_bounds(input);
  double sum = 0.0;
  for (std::size_t i = 0; i < bounds.tags.size(); ++i) {
    sum += mean_horizontal_error(covariance_of(bounds, i));
  }
  return sum / static_cast<double>(bounds.tags.size());
}

struct Case {
  made::Noise noise;
  unsigned seeds = 12;
};

struct Outcome {
  Errors joint;
  Errors single;
  double bound = 0.0;
};

Outcome outcome_of(const Case& of) {
  Outcome outcome;
  for (unsigned seed = 1; seed <= of.seeds; ++seed) {
    made::Rng rng(seed);
    const made::Path path = made::aisles(0.02);
    const made::Hall hall = made::hall(path, 8, of.noise, rng);
    add(hall, run(joint_method(), hall.problem), outcome.joint);
    add(hall, run(maximum_likelihood_method(), hall.problem), outcome.single);
    outcome.bound += bound_of(hall, path, of.noise.phase_rad) / of.seeds;
  }
  return outcome;
}

TEST(Joint, IsNearTheBoundWithPoseErrors) {
  Case of;
  of.noise.pose_m = 0.02;
  const Outcome outcome = outcome_of(of);
  EXPECT_EQ(outcome.joint.not_located, 0U);
  // Errors of a run are correlated: the mean of 12 runs has a standard deviation of about a tenth.
  EXPECT_LT(outcome.joint.mean(), 1.25 * outcome.bound);
  EXPECT_GT(outcome.joint.mean(), 0.75 * outcome.bound);
  EXPECT_GT(outcome.single.mean(), 2.0 * outcome.joint.mean());
}

TEST(Joint, IsTheSingleEstimateWhereThePoseIsTrue) {
  Case of;
  of.seeds = 4;
  const Outcome outcome = outcome_of(of);
  EXPECT_NEAR(outcome.joint.mean(), outcome.single.mean(), 0.05 * outcome.bound);
}

TEST(Joint, APauseOfADayChangesEstimatesByLessThanTheirDeviation) {
  made::Noise noise;
  noise.pose_m = 0.02;
  for (const bool stated : {true, false}) {
    made::Rng rng(7);
    made::Hall hall = made::hall(made::aisles(0.02), 8, noise, rng);
    if (!stated) hall.problem.pose_error.reset();
    made::Hall paused = hall;
    made::pause(paused, 36.0, 86400.0);
    const LocalizationResult without = run(joint_method(), hall.problem);
    const LocalizationResult with = run(joint_method(), paused.problem);
    for (std::size_t i = 0; i < with.estimates.size(); ++i) {
      const Candidate& a = without.estimates[i].candidates.front();
      const Candidate& b = with.estimates[i].candidates.front();
      ASSERT_TRUE(b.p_WT.allFinite() && b.covariance->allFinite());
      EXPECT_LT((a.p_WT - b.p_WT).head<2>().norm(), a.expected_error_m);
      EXPECT_NEAR(b.expected_error_m, a.expected_error_m, 0.3 * a.expected_error_m);
    }
  }
}

/// A hall whose pose errors are drawn separately for two halves of the path, as on two days.
made::Hall hall_of_two_days(unsigned seed) {
  made::Noise noise;
  noise.pose_m = 0.02;
  made::Rng rng(seed);
  const made::Path path = made::aisles(0.02);
  made::Path beliefs = made::believed(path, noise, made::kPathRate, rng);
  const made::Path later = made::believed(path, noise, made::kPathRate, rng);
  std::copy(later.begin() + 541, later.end(), beliefs.begin() + 541);
  made::Hall hall = made::hall(path, beliefs, 8, noise, rng);
  made::pause(hall, 36.0, 86400.0);
  return hall;
}

TEST(Joint, HasHonestCovariancesWithPausesInWhichThePoseErrorIsForgotten) {
  Errors errors;
  for (unsigned seed = 1; seed <= 12; ++seed) {
    const made::Hall hall = hall_of_two_days(seed);
    add(hall, run(joint_method(), hall.problem), errors);
  }
  EXPECT_EQ(errors.not_located, 0U);
  // Expected 2; errors of a run are correlated, so the mean of 12 runs has a standard deviation of
  // a fifth.
  const double nees = errors.nees / static_cast<double>(errors.all.size());
  EXPECT_GT(nees, 1.2);
  EXPECT_LT(nees, 2.8);
}

TEST(Joint, GoesOnToAPlaceThatExplainsTheWrappedPhasesFarBetter) {
  // Of 4,000 such halls, those in which tags are at a position with six times the residuals of
  // another once their phases are wrapped.
  for (const unsigned seed : {2261U, 2358U, 2364U, 2542U}) {
    const made::Hall hall = hall_of_two_days(seed);
    Errors errors;
    add(hall, run(joint_method(), hall.problem), errors);
    ASSERT_EQ(errors.not_located, 0U) << seed;
    EXPECT_LT(*std::max_element(errors.all.begin(), errors.all.end()), 0.15) << seed;
  }
}

TEST(Joint, LearnsTheStrengthOfThePoseError) {
  made::Noise noise;
  noise.pose_m = 0.02;
  Errors stated;
  Errors learnt;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    made::Rng rng(seed);
    made::Hall hall = made::hall(made::aisles(0.02), 8, noise, rng);
    add(hall, run(joint_method(), hall.problem), stated);
    hall.problem.pose_error.reset();
    add(hall, run(joint_method(), hall.problem), learnt);
  }
  EXPECT_LT(learnt.mean(), 1.25 * stated.mean());
}

TEST(Joint, ReferenceTagsFixTheWorld) {
  made::Noise noise;
  noise.pose_m = 0.03;
  noise.pose_time = 1000.0;  // Practically a constant shift of the map.
  Errors without;
  Errors with;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    made::Rng rng(seed);
    made::Hall hall = made::hall(made::aisles(0.02), 8, noise, rng);
    add(hall, run(joint_method(), hall.problem), without);
    for (const char* tag : {"t0", "t1", "t2"}) {
      hall.problem.reference_tags[tag] = hall.truth.at(tag);
    }
    const LocalizationResult result = run(joint_method(), hall.problem);
    EXPECT_TRUE(result.estimates[0].candidates[0].p_WT == hall.truth.at("t0"));
    LocalizationResult others = result;
    others.estimates.erase(others.estimates.begin(), others.estimates.begin() + 3);
    add(hall, others, with);
  }
  EXPECT_LT(with.mean(), 0.3 * without.mean());
}

/// An L with stops of 3 to 15 s, as of a robot that waits.
made::Path with_stops(const made::Path& path, made::Rng& rng) {
  made::Path stopping;
  for (const Eigen::Vector3d& p_WA : path) {
    const bool stops = made::uniform(rng, 0.0, 1.0) < 4.0 / static_cast<double>(path.size());
    const auto times = stops ? static_cast<std::size_t>(made::uniform(rng, 45.0, 225.0)) : 1;
    stopping.insert(stopping.end(), times, p_WA);
  }
  return stopping;
}

// One tag whose phases are unwrapped wrongly bends the pose error, though it is refused itself.
// Here others were 0.2 m off with 2 to 3 cm stated.
TEST(Joint, ATagThatIsRefusedDoesNotMoveTheOthers) {
  made::Noise noise;
  noise.pose_m = 0.03;
  int located = 0;
  int refused = 0;
  for (const unsigned seed : {168U, 188U, 203U}) {
    made::Rng rng(seed);
    const double along = made::uniform(rng, 3.0, 6.0);
    const made::Path path = made::l_turn(along, made::uniform(rng, 3.0, 6.0), 0.02);
    const made::Hall hall = made::hall(with_stops(path, rng), 5, noise, rng);
    for (const TagEstimate& estimate : run(joint_method(), hall.problem).estimates) {
      if (estimate.verdict == Verdict::kNotLocated) ++refused;
      if (estimate.verdict != Verdict::kLocated) continue;
      ++located;
      const Candidate& best = estimate.candidates.front();
      const double error = (best.p_WT - hall.truth.at(estimate.tag)).head<2>().norm();
      EXPECT_LT(error, std::max(0.05, 3.0 * best.expected_error_m)) << seed << estimate.tag;
    }
  }
  EXPECT_GE(located, 8);
  EXPECT_GE(refused, 3);
}

TEST(Joint, SaysThatAStraightPathIsAmbiguous) {
  for (const double pose_m : {0.0, 0.01}) {
    made::Noise noise;
    noise.pose_m = pose_m;
    made::Rng rng(3);
    const made::Hall hall = made::hall(made::straight(12.0, 0.02), 4, noise, rng);
    for (const TagEstimate& estimate : run(joint_method(), hall.problem).estimates) {
      ASSERT_EQ(estimate.verdict, Verdict::kAmbiguous) << estimate.tag << estimate.reason;
      const Eigen::Vector3d truth = hall.truth.at(estimate.tag);
      double nearest = 1e9;
      for (const Candidate& candidate : estimate.candidates) {
        nearest = std::min(nearest, (candidate.p_WT - truth).head<2>().norm());
      }
      EXPECT_LT(nearest, pose_m > 0.0 ? 0.15 : 0.03);
    }
  }
}

// Two straight aisles so far apart that each tag is read from only one of them: the side of a tag
// can't be determined, though the path as a whole is bent.
TEST(Joint, SaysThatEachOfSeveralAislesIsAmbiguous) {
  made::Noise noise;
  noise.pose_m = 0.03;
  made::Rng rng(11);
  const double half_turn = 3.0 * kPi;  // Arc length for a radius of 3 m.
  const made::Path path = made::follow(
      16.0 + half_turn, 0.02, [&](double s) { return std::clamp((s - 8.0) / 3.0, 0.0, kPi); });
  const made::Path beliefs = made::believed(path, noise, made::kPathRate, rng);
  made::ReaderSetup setup;
  setup.range_m = 2.5;
  LocalizationProblem problem;
  problem.heights.of_all = 0.4;
  problem.pose_error = PoseErrorModel{0.03, 0.0, 5.0};
  for (int i = 0; i < 8; ++i) {
    const double x = 2.6 + 0.4 * i;
    const std::string id = "t" + std::to_string(i);
    for (const double aisle : {0.0, 6.0}) {
      problem.samples[id + (aisle > 0.0 ? "b" : "a")]["a"] = made::read_along(
          path, beliefs, {x, aisle + (i % 2 == 0 ? 1.3 : -1.3), 0.4}, noise, rng, setup);
    }
  }
  std::vector<StampedPose> way;
  for (std::size_t i = 0; i < beliefs.size(); ++i) {
    way.push_back({time_from_seconds(setup.start_s) +
                       duration_from_seconds(static_cast<double>(i) / setup.rate_hz),
                   from_translation(beliefs[i])});
  }
  problem.tracks["a"].X_WA = way;
  int located = 0;
  for (const TagEstimate& estimate : run(joint_method(), problem).estimates) {
    if (estimate.verdict == Verdict::kLocated) ++located;
  }
  EXPECT_EQ(located, 0);
}

TEST(Joint, GivesCorrectedPoses) {
  made::Noise noise;
  noise.pose_m = 0.03;
  made::Rng rng(5);
  const made::Path path = made::aisles(0.02);
  const made::Path beliefs = made::believed(path, noise, made::kPathRate, rng);
  const made::Hall hall = made::hall(path, beliefs, 8, noise, rng);
  const LocalizationResult result = run(joint_method(), hall.problem);
  ASSERT_EQ(result.corrected_poses.size(), path.size());
  double before = 0.0;
  double after = 0.0;
  for (std::size_t i = 0; i < path.size(); ++i) {
    before += (beliefs[i] - path[i]).squaredNorm();
    after += (result.corrected_poses[i].X_WA.translation - path[i]).squaredNorm();
  }
  EXPECT_LT(after, 0.5 * before);
}

TEST(Joint, RefusesLateReads) {
  made::Rng rng(2);
  const made::Path path = made::s_curve(14.0, 0.02);
  for (const bool twice : {false, true}) {
    made::Hall hall = made::hall(path, path, 8, {}, rng);
    made::make_late(hall, 0.4);
    hall.problem.pose_error.reset();
    // A log may give a pose twice, at one stamp.
    Trajectory& track = hall.problem.tracks.at("a").X_WA;
    if (twice) {
      const StampedPose third = track[2];
      track.insert(track.begin() + 2, {third, third});
    }
    Diagnostics diagnostics;
    const LocalizationResult result = joint_method().locate(hall.problem, 2, diagnostics);
    for (const TagEstimate& estimate : result.estimates) {
      EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
      EXPECT_NE(estimate.reason.find("as if stamps of reads were 0.4"), std::string::npos)
          << estimate.reason;
    }
  }
}

TEST(Joint, TakesTagsThatTellNothing) {
  made::Noise noise;
  made::Rng rng(6);
  made::Hall hall = made::hall(made::aisles(0.02), 3, noise, rng);
  hall.problem.samples["t1"]["a"].resize(1);
  hall.problem.samples["t2"].clear();
  const LocalizationResult result = run(joint_method(), hall.problem);
  ASSERT_EQ(result.estimates.size(), 3U);
  EXPECT_EQ(result.estimates[0].verdict, Verdict::kLocated);
  EXPECT_NE(result.estimates[1].reason.find("only 1 reads"), std::string::npos);
  EXPECT_NE(result.estimates[2].reason.find("no reads"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
