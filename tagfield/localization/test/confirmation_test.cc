// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/confirmation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "tagfield/localization/joint/joint.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/test/problem_of.h"
#include "tagfield/localization/test/reflections.h"

namespace tagfield {
namespace {

using made::Rng;

made::Hall hall_of(int tags, Rng& rng) {
  const made::Path path = made::s_curve(8.0, 0.02);
  made::Hall hall = made::hall(path, path, tags, {}, rng);
  hall.problem.pose_error.reset();
  return hall;
}

TEST(Confirmation, PosesOfAnotherDriveLocateNothing) {
  Rng rng(1);
  made::Hall hall = hall_of(20, rng);
  for (auto& [tag, samples] : hall.problem.samples) {
    for (PhaseSample& sample : samples["a"]) {
      sample.p_WA.y() = -0.5 * sample.p_WA.y() + 0.1 * sample.p_WA.x();
    }
  }
  for (const char* method : {"ml", "sar", "particle"}) {
    Diagnostics diagnostics;
    LocalizationResult result =
        find_method(built_in_methods(), method).locate(hall.problem, 2, diagnostics);
    refuse_unconfirmed(hall.problem, 2, result);
    for (const TagEstimate& estimate : result.estimates) {
      EXPECT_NE(estimate.verdict, Verdict::kLocated) << method << " " << estimate.tag;
    }
  }
}

TEST(Confirmation, RightPlacesAmidReflectionsStay) {
  Rng rng(2);
  made::Hall hall = hall_of(20, rng);
  made::reflect(made::walls(0.7), hall);
  Diagnostics diagnostics;
  LocalizationResult result =
      find_method(built_in_methods(), "sar").locate(hall.problem, 2, diagnostics);
  const std::vector<TagEstimate> before = result.estimates;
  refuse_unconfirmed(hall.problem, 2, result);
  int right = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (before[i].verdict != Verdict::kLocated) continue;
    const Eigen::Vector3d& truth = hall.truth.at(before[i].tag);
    const double error = (before[i].candidates.front().p_WT - truth).norm();
    if (error < before[i].candidates.front().expected_error_m) {
      ++right;
      EXPECT_EQ(result.estimates[i].verdict, Verdict::kLocated) << before[i].tag;
    }
  }
  EXPECT_GT(right, 0);
}

struct JointClaims {
  int located = 0;
  int wrong = 0;  ///< Over five expected errors off.
};

/// Of tags at rest, and of those that were at two places, either of which would be right.
JointClaims claims_of(const LocalizationResult& result, const made::Hall& hall,
                      const std::map<std::string, Eigen::Vector3d>& later) {
  JointClaims claims;
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    const Candidate& claim = estimate.candidates.front();
    double error = (claim.p_WT - hall.truth.at(estimate.tag)).norm();
    const auto moved = later.find(estimate.tag);
    if (moved != later.end()) error = std::min(error, (claim.p_WT - moved->second).norm());
    ++claims.located;
    if (error > 5.0 * claim.expected_error_m) ++claims.wrong;
  }
  return claims;
}

TEST(Confirmation, TagsThatDoNotFitThePosesThatJointCorrectsAreRefused) {
  JointClaims before;
  JointClaims after;
  JointClaims at_rest;
  for (unsigned seed = 1; seed <= 8; ++seed) {
    Rng rng(seed);
    const made::Path path = made::loop(12.0, 0.02);
    made::Hall hall = made::hall(path, path, 10, {}, rng);
    hall.problem.pose_error.reset();
    Diagnostics diagnostics;
    LocalizationResult result = joint_method().locate(hall.problem, 2, diagnostics);
    const int found = claims_of(result, hall, {}).located;
    refuse_unconfirmed(hall.problem, 2, result);
    EXPECT_EQ(claims_of(result, hall, {}).located, found) << seed;
    at_rest.located += found;
    // Two tags are moved in the middle of the run.
    std::map<std::string, Eigen::Vector3d> later;
    for (const std::string tag : {"t0", "t1"}) {
      later[tag] = hall.truth[tag] + Eigen::Vector3d(0.8, tag == "t0" ? 0.6 : -0.6, 0.0);
      std::vector<PhaseSample>& series = hall.problem.samples[tag]["a"];
      const std::vector<PhaseSample> moved = made::read_along(path, path, later[tag], {}, rng);
      std::copy(moved.begin() + static_cast<std::ptrdiff_t>(moved.size() / 2), moved.end(),
                series.begin() + static_cast<std::ptrdiff_t>(series.size() / 2));
    }
    result = joint_method().locate(hall.problem, 2, diagnostics);
    before.wrong += claims_of(result, hall, later).wrong;
    refuse_unconfirmed(hall.problem, 2, result);
    after.wrong += claims_of(result, hall, later).wrong;
    after.located += claims_of(result, hall, later).located;
  }
  EXPECT_GE(at_rest.located, 60);
  EXPECT_GE(before.wrong, 3);
  EXPECT_LE(3 * after.wrong, before.wrong);
  EXPECT_GE(after.located, 50);
}

}  // namespace
}  // namespace tagfield
