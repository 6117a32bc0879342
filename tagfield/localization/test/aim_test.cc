// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/aim.h"

#include <gtest/gtest.h>

#include "method_study.h"

namespace tagfield {
namespace {

using namespace made;

/// Antennas with boresights along +y and −y, and a tag at (3, 2) or its mirror image.
struct Aisle {
  double front_to_back_db = 20.0;
  double fading_db = 5.0;
  double other_level_db = 0.0;  ///< Level of the antenna that faces away, due to its cable.
  bool orientation_known = true;
};

LocalizationProblem problem_of(const Aisle& aisle, Rng& rng) {
  const Path path = straight(8.0, 0.03);
  const Eigen::Vector3d p_WT(3.0, 2.0, 0.4);
  LocalizationProblem problem = one_tag({}, 0.4);
  for (const double look : {1.0, -1.0}) {
    const std::string antenna = look > 0.0 ? "left" : "right";
    auto& series = problem.samples["t"][antenna];
    series = read_along(path, path, p_WT, Noise{}, rng);
    const double yaw = aisle.orientation_known ? look * kPi / 2.0 : 0.0;
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    double fading = 0.0;
    for (PhaseSample& s : series) {
      const Eigen::Vector3d way = p_WT - s.p_WA;
      const double cosine = look * way.y() / way.norm();
      // Decorrelates over a few decimetres.
      fading = 0.9 * fading + normal(rng, aisle.fading_db * std::sqrt(1.0 - 0.81));
      s.rssi_dbm = -40.0 - 40.0 * std::log10(way.norm()) + 0.5 * aisle.front_to_back_db * cosine +
                   fading + (look < 0.0 ? aisle.other_level_db : 0.0);
      problem.tracks[antenna].X_WA.push_back({s.stamp, {rotation, s.p_WA}});
    }
  }
  return problem;
}

LocalizationResult both_images() {
  TagEstimate estimate;
  estimate.tag = "t";
  estimate.verdict = Verdict::kAmbiguous;
  estimate.candidates = {{{3.0, -2.0, 0.4}, 0.01, 0.02}, {{3.0, 2.0, 0.4}, 0.01, 0.02}};
  LocalizationResult result;
  result.estimates = {estimate};
  return result;
}

TEST(Aim, TellsThePlaceInFrontFromThatBehind) {
  Rng rng(1);
  for (int i = 0; i < 50; ++i) {
    LocalizationResult result = both_images();
    drop_candidates_behind(problem_of({}, rng), result);
    const TagEstimate& estimate = result.estimates.at(0);
    ASSERT_EQ(estimate.verdict, Verdict::kLocated) << i;
    EXPECT_GT(estimate.candidates.at(0).p_WT.y(), 0.0) << i;
  }
}

TEST(Aim, SeldomDropsTheTruthWhereItTellsNothing) {
  Rng rng(2);
  int dropped = 0;
  for (int i = 0; i < 200; ++i) {
    LocalizationResult result = both_images();
    drop_candidates_behind(problem_of({.front_to_back_db = 0.0, .other_level_db = 3.0}, rng),
                           result);
    const auto& kept = result.estimates.at(0).candidates;
    dropped += kept.size() == 1 && kept.at(0).p_WT.y() < 0.0 ? 1 : 0;
  }
  // The target is one in a hundred; a level difference of 3 dB adds one standard deviation.
  EXPECT_LE(dropped, 10);
}

TEST(Aim, DoesNothingWithoutOrientationOrStrength) {
  Rng rng(3);
  LocalizationResult result = both_images();
  drop_candidates_behind(problem_of({.orientation_known = false}, rng), result);
  EXPECT_EQ(result.estimates.at(0).candidates.size(), 2U);
  LocalizationProblem silent = problem_of({}, rng);
  for (auto& [antenna, series] : silent.samples.at("t")) {
    for (PhaseSample& s : series) s.rssi_dbm = kNoRssi;
  }
  drop_candidates_behind(silent, result);
  EXPECT_EQ(result.estimates.at(0).candidates.size(), 2U);
}

/// Result with both antennas, whose poses are exchanged if `swapped`.
LocalizationResult held_against_aims(LocalizationProblem problem, bool swapped,
                                     Diagnostics& diagnostics) {
  if (swapped) std::swap(problem.tracks.at("left"), problem.tracks.at("right"));
  TagEstimate estimate;
  estimate.tag = "t";
  estimate.verdict = Verdict::kLocated;
  estimate.candidates = {{{3.0, 2.0, 0.4}, 0.01, 0.02}};
  LocalizationResult result;
  result.estimates = {estimate};
  refuse_swapped_antennas(problem, result, diagnostics);
  return result;
}

TEST(Aim, SwappedAntennasReadWithTheirBacks) {
  Rng rng(5);
  int refused = 0;
  for (int i = 0; i < 20; ++i) {
    const LocalizationProblem problem = problem_of({}, rng);
    Diagnostics fine;
    EXPECT_EQ(held_against_aims(problem, false, fine).estimates.at(0).verdict, Verdict::kLocated);
    EXPECT_TRUE(fine.warnings().empty());
    Diagnostics wrong;
    const LocalizationResult result = held_against_aims(problem, true, wrong);
    if (result.estimates.at(0).verdict == Verdict::kLocated) continue;
    ++refused;
    ASSERT_EQ(wrong.warnings().size(), 1U);
    EXPECT_NE(wrong.warnings().front().find("'left' and 'right'"), std::string::npos);
  }
  EXPECT_GE(refused, 15);
}

TEST(Aim, AntennasWithoutAFrontAreNotCalledSwapped) {
  Rng rng(6);
  for (int i = 0; i < 200; ++i) {
    for (const bool swapped : {false, true}) {
      Diagnostics diagnostics;
      held_against_aims(problem_of({.front_to_back_db = 0.0, .other_level_db = 3.0}, rng), swapped,
                        diagnostics);
      EXPECT_TRUE(diagnostics.warnings().empty()) << i;
    }
  }
}

}  // namespace
}  // namespace tagfield
