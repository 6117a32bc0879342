// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/common_latency.h"

#include <gtest/gtest.h>

#include <string>

#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/joint/joint.h"
#include "tagfield/localization/test/problem_of.h"
#include "tagfield/localization/test/reflections.h"

namespace tagfield {
namespace {

/// A hall with reflections from walls and floor.
made::Hall reflecting_hall(unsigned seed, double late_s, const made::Noise& noise = {}) {
  made::Rng rng(seed);
  const made::Path path = made::aisles(0.03);  // At 0.45 m/s.
  made::Hall hall =
      made::hall(path, made::believed(path, noise, made::kPathRate, rng), 8, noise, rng);
  made::reflect(made::walls(0.4), hall);
  made::make_late(hall, late_s);
  return hall;
}

LocalizationResult located(const made::Hall& hall) {
  Diagnostics diagnostics;
  return robust_method().locate(hall.problem, 2, diagnostics);
}

int claims(const LocalizationResult& result) {
  int count = 0;
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict == Verdict::kLocated) ++count;
  }
  return count;
}

/// Number of tags off by more than five expected errors.
int false_claims(const LocalizationResult& result, const made::Hall& hall) {
  int count = 0;
  for (const TagEstimate& estimate : result.estimates) {
    if (estimate.verdict != Verdict::kLocated) continue;
    const Candidate& claim = estimate.candidates.front();
    const double off = (claim.p_WT - hall.truth.at(estimate.tag)).norm();
    if (off > 5.0 * claim.expected_error_m) ++count;
  }
  return count;
}

TEST(CommonLatency, OfLateReadsNoPlaceIsClaimedAmidReflections) {
  int before = 0;
  int after = 0;
  for (const double late_s : {-1.0, -0.6, 0.6, 1.0}) {
    for (unsigned seed = 1; seed <= 4; ++seed) {
      const made::Hall hall = reflecting_hall(seed, late_s);
      LocalizationResult result = located(hall);
      before += false_claims(result, hall);
      Diagnostics diagnostics;
      refuse_common_latency(hall.problem, 2, result, diagnostics);
      after += false_claims(result, hall);
    }
  }
  EXPECT_GE(before, 20);  // Of 128 tags: false claims without the check.
  EXPECT_LT(10 * after, before);
}

TEST(CommonLatency, SaysHowLateTheReadsAre) {
  made::Hall hall = reflecting_hall(1, 0.6);
  LocalizationResult result = located(hall);
  ASSERT_GE(claims(result), 2);
  Diagnostics diagnostics;
  refuse_common_latency(hall.problem, 1, result, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  const std::string& warning = diagnostics.warnings().front();
  const auto at = warning.find("stamped ");
  ASSERT_NE(at, std::string::npos) << warning;
  EXPECT_NEAR(std::stod(warning.substr(at + 8)), 0.6, 0.06) << warning;
  EXPECT_NE(warning.find(" s late"), std::string::npos) << warning;
}

// On an L each leg's tags fix their own part of the path, which joint moves with them.
TEST(CommonLatency, JointDoesNotTakeItForAPoseError) {
  int before = 0;
  int after = 0;
  int in_time = 0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    for (const double late_s : {0.0, 0.3}) {
      made::Rng rng(seed);
      const made::Path path = made::l_turn(6.0, 6.0, 0.03);  // At 0.45 m/s.
      made::Hall hall = made::hall(path, path, 10, {}, rng);
      hall.problem.pose_error.reset();
      made::make_late(hall, late_s);
      Diagnostics diagnostics;
      LocalizationResult result = joint_method().locate(hall.problem, 2, diagnostics);
      const int found = claims(result);
      if (late_s > 0.0) before += false_claims(result, hall);
      refuse_common_latency(hall.problem, 2, result, diagnostics);
      if (late_s > 0.0) after += false_claims(result, hall);
      if (late_s == 0.0) {
        EXPECT_EQ(claims(result), found) << seed;
        in_time += found;
      }
    }
  }
  EXPECT_GE(before, 10);
  EXPECT_EQ(after, 0);
  EXPECT_GE(in_time, 30);
}

TEST(CommonLatency, ReadsInTimeKeepTheirPlaces) {
  made::Noise shaky;
  shaky.pose_m = 0.02;
  for (const made::Noise& noise : {made::Noise{}, shaky}) {
    for (unsigned seed = 1; seed <= 8; ++seed) {
      const made::Hall hall = reflecting_hall(seed, 0.0, noise);
      LocalizationResult result = located(hall);
      const int before = claims(result);
      Diagnostics diagnostics;
      refuse_common_latency(hall.problem, 2, result, diagnostics);
      EXPECT_EQ(claims(result), before) << seed;
      EXPECT_TRUE(diagnostics.warnings().empty()) << seed;
    }
  }
}

TEST(CommonLatency, NothingIsSaidOfAntennasAtRest) {
  made::Rng rng(1);
  const made::Path path(200, Eigen::Vector3d(0.0, 0.0, 1.0));
  made::Hall hall = made::hall(path, path, 2, {}, rng);
  LocalizationResult result;
  for (const auto& [tag, p_WT] : hall.truth) {
    TagEstimate estimate;
    estimate.tag = tag;
    estimate.verdict = Verdict::kLocated;
    estimate.candidates.resize(1);
    estimate.candidates.front().p_WT = p_WT;
    result.estimates.push_back(estimate);
  }
  Diagnostics diagnostics;
  refuse_common_latency(hall.problem, 1, result, diagnostics);
  EXPECT_EQ(claims(result), 2);
  EXPECT_TRUE(diagnostics.warnings().empty());
}

}  // namespace
}  // namespace tagfield
