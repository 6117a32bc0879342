// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/confirmation.h"

#include <gtest/gtest.h>

#include <string>

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

}  // namespace
}  // namespace tagfield
