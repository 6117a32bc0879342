// SPDX-License-Identifier: Apache-2.0
#include "tagfield/localization/joint/multipath.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <map>

#include "method_study.h"
#include "problem_of.h"
#include "reflections.h"
#include "tagfield/base/units.h"
#include "tagfield/localization/holograms/robust.h"
#include "tagfield/localization/locate.h"
#include "tagfield/localization/pi_ambiguity.h"

namespace tagfield {
namespace {

using namespace made;

struct TracedStudy {
  double pose_m = 0.0;
  double gain = 0.5;           ///< Reflection coefficient of the walls.
  double believed_gain = 0.5;  ///< The believed one.
  bool pi_ambiguity = false;
  bool pose_error_stated = true;
  double walls_off_m = 0.0;    ///< Distance of the walls from their believed positions.
  double world_sigma_m = 0.0;  ///< Stated standard deviation of that.
  double strays = 0.0;         ///< Share of reads with a random phase.
};

std::vector<Mirror> moved(std::vector<Mirror> mirrors, double by_m) {
  for (Mirror& mirror : mirrors) mirror.at += by_m;
  return mirrors;
}

void stray(double share, Hall& hall, Rng& rng) {
  for (auto& [tag, of_tag] : hall.problem.samples) {
    for (PhaseSample& sample : of_tag["a"]) {
      if (uniform(rng, 0.0, 1.0) < share) sample.phase_rad = uniform(rng, 0.0, kTwoPi);
    }
  }
}

std::size_t about_the_world(const Diagnostics& diagnostics) {
  const std::vector<std::string>& all = diagnostics.warnings();
  return static_cast<std::size_t>(std::count_if(all.begin(), all.end(), [](const auto& warning) {
    return warning.find("don't fit the known world") != std::string::npos;
  }));
}

/// A seed's reads.
Hall hall_of(const TracedStudy& study, unsigned seed) {
  Noise noise;
  noise.pose_m = study.pose_m;
  Rng rng(seed);
  const Path path = aisles(0.03);
  const Path beliefs = believed(path, noise, kPathRate, rng);
  // Reflections are computed at the true positions of the antenna.
  Hall hall = made::hall(path, path, 4, Noise{}, rng);
  reflect(walls(study.gain), hall);
  stray(study.strays, hall, rng);
  hall.problem.tracks["a"] = track_along(beliefs);
  for (auto& [tag, of_tag] : hall.problem.samples) {
    for (PhaseSample& s : of_tag["a"]) {
      const double step = (to_seconds(s.stamp) - ReaderSetup{}.start_s) * kPathRate;
      s.p_WA = beliefs.at(static_cast<std::size_t>(step + 0.5));
    }
  }
  hall.problem.pose_error.reset();
  if (study.pose_error_stated) hall.problem.pose_error = PoseErrorModel{study.pose_m, 0.0, 5.0};
  hall.problem.pi_ambiguity = study.pi_ambiguity;
  if (study.pi_ambiguity) double_phases(hall.problem.samples);
  hall.problem.trace = known_mirrors(moved(walls(study.believed_gain), study.walls_off_m));
  hall.problem.world_sigma_m = study.world_sigma_m;
  return hall;
}

Tally with(const Method& method, const TracedStudy& study, std::size_t* warnings = nullptr) {
  Tally tally;
  for (const unsigned seed : {1U, 2U}) {
    const Hall hall = hall_of(study, seed);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate : method.locate(hall.problem, 2, diagnostics).estimates) {
      tally.add(estimate, hall.truth.at(estimate.tag));
    }
    if (warnings != nullptr) *warnings += about_the_world(diagnostics);
  }
  tally.finish();
  return tally;
}

TEST(Multipath, WithTheWorldKnownReflectionsAreTakenOut) {
  for (const bool pi_ambiguity : {false, true}) {
    const Tally tally = with(multipath_method(), {.pi_ambiguity = pi_ambiguity});
    const Tally robust = with(robust_method(), {.pi_ambiguity = pi_ambiguity});
    EXPECT_GE(tally.errors.size(), 7U) << pi_ambiguity;  // Of 8.
    EXPECT_LT(tally.part(0.5), 0.003) << pi_ambiguity;
    EXPECT_LT(tally.errors.back(), 0.05) << pi_ambiguity;
    EXPECT_LT(tally.part(0.5), 0.3 * robust.part(0.5)) << pi_ambiguity;
    EXPECT_LT(tally.calibration(), 1.5) << pi_ambiguity;
  }
}

TEST(Multipath, LocatesWhereReflectionsAreNearlyAsStrongAsTheDirectPath) {
  // Three mirrors together have twice the direct path's amplitude. Positions are not checked
  // against the uncorrected phases, which the direct path alone no longer explains.
  const Method checked = {
      "checked", "", [](const LocalizationProblem& problem, int threads, Diagnostics& diagnostics) {
        LocalizationProblem own = problem;
        return locate_problem(multipath_method(), own, threads, diagnostics);
      }};
  const Tally tally = with(checked, {.gain = 0.8, .believed_gain = 0.8, .pi_ambiguity = true});
  EXPECT_GE(tally.errors.size(), 7U);  // Of 8.
  EXPECT_LT(tally.part(0.5), 0.003);
  EXPECT_EQ(tally.worse_than(0.3), 0U);
}

TEST(Multipath, EstimatesThePoseErrorToo) {
  for (const bool stated : {true, false}) {
    const Tally tally = with(multipath_method(), {.pose_m = 0.01, .pose_error_stated = stated});
    EXPECT_GE(tally.errors.size(), 6U) << stated;
    EXPECT_LT(tally.part(0.5), 0.015) << stated;
    EXPECT_EQ(tally.worse_than(0.3), 0U) << stated;
    EXPECT_LT(tally.calibration(), 2.0) << stated;
  }
}

TEST(Multipath, AWorldKnownWronglyIsNoCertainty) {
  std::size_t warnings = 0;
  const Tally tally = with(multipath_method(), {.believed_gain = -0.5}, &warnings);
  EXPECT_EQ(warnings, 2U);  // One per run: that the phases don't fit the known world.
  EXPECT_EQ(tally.worse_than(0.3), 0U);
  EXPECT_LT(tally.calibration(), 3.0);
}

TEST(Multipath, ErrorsOfAWorldThatIsOffAreExpected) {
  TracedStudy study{.pi_ambiguity = true, .walls_off_m = 0.01};
  const double bold = with(multipath_method(), study).calibration();
  study.world_sigma_m = 0.01;
  const Tally tally = with(multipath_method(), study);
  EXPECT_GE(tally.errors.size(), 7U);  // Of 8.
  EXPECT_LT(tally.calibration(), 1.5);
  EXPECT_GT(bold, 2.0 * tally.calibration());
}

TEST(Multipath, AFewReadsThatNoPathExplainsDoNoHarm) {
  const Tally tally = with(multipath_method(), {.pi_ambiguity = true, .strays = 0.05});
  EXPECT_GE(tally.errors.size(), 7U);  // Of 8.
  EXPECT_LT(tally.part(0.5), 0.003);
  EXPECT_LT(tally.errors.back(), 0.05);
  EXPECT_LT(tally.calibration(), 1.5);
}

/// Phase shift of a reply due to mirrors, relative to the direct path [rad].
double bend_of(const TracedReply& reply, const Eigen::Vector3d& p_WT, double frequency_hz) {
  std::complex<double> all = 0.0;
  std::complex<double> direct = 0.0;
  for (const TracedWave& wave : reply.forward) {
    const double length_m = (p_WT - wave.source_W).norm();
    const std::complex<double> here =
        wave.amplitude / length_m *
        std::polar(1.0, -kTwoPi * frequency_hz / kSpeedOfLight * length_m);
    all += here;
    if (wave.direct) direct = here;
  }
  return -2.0 * std::arg(all / direct);
}

TEST(Multipath, WhatIsExplainedIsOfThePlaceThatIsClaimed) {
  // After one round the joint fit has hardly converged, and tags are refined from there.
  const std::vector<Mirror> mirrors = walls(0.95);
  std::size_t claimed = 0;
  double most = 0.0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Hall hall = hall_of({.pose_m = 0.03, .gain = 0.95, .believed_gain = 0.95}, seed);
    Diagnostics diagnostics;
    const LocalizationResult result =
        multipath_method({.rounds = 1}).locate(hall.problem, 2, diagnostics);
    std::map<Time, RigidTransform> corrected;
    for (const AntennaPose& pose : result.corrected_poses) corrected[pose.stamp] = pose.X_WA;
    for (const TagEstimate& estimate : result.estimates) {
      const auto explained = result.explained.find(estimate.tag);
      if (explained == result.explained.end()) continue;
      ++claimed;
      const Eigen::Vector3d& p_WT = estimate.candidates.front().p_WT;
      std::map<Time, double> measured;
      for (const PhaseSample& s : hall.problem.samples.at(estimate.tag).at("a")) {
        measured[s.stamp] = s.phase_rad;
      }
      for (const PhaseSample& s : explained->second.at("a")) {
        const auto pose = corrected.find(s.stamp);
        if (pose == corrected.end()) continue;
        const TracedReply reply = replies_of(mirrors, p_WT, {{pose->second}, {s.frequency_hz}})[0];
        const double bend = bend_of(reply, p_WT, s.frequency_hz);
        most = std::max(most, std::abs(wrap_to_pi(measured.at(s.stamp) - s.phase_rad - bend)));
      }
    }
  }
  EXPECT_GE(claimed, 12U);  // Of 24.
  EXPECT_LT(most, 1e-3);
}

TEST(Multipath, NoBentPathExplainsAWrongPosition) {
  Tally tally;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const Hall hall = hall_of({.pose_m = 0.02}, seed);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate :
         multipath_method().locate(hall.problem, 2, diagnostics).estimates) {
      tally.add(estimate, hall.truth.at(estimate.tag));
      if (estimate.verdict != Verdict::kLocated) continue;
      const Candidate& claimed = estimate.candidates.front();
      const double error = (claimed.p_WT - hall.truth.at(estimate.tag)).norm();
      EXPECT_LT(error, 5.0 * claimed.expected_error_m) << seed << " " << estimate.tag;
    }
  }
  tally.finish();
  EXPECT_GE(tally.errors.size(), 150U);  // Of 160.
}

TEST(Multipath, WithoutAWorldSaysSo) {
  Rng rng(1);
  const Hall hall = made::hall(aisles(0.03), 1, Noise{}, rng);
  const TagEstimate estimate = locate_one(multipath_method(), hall.problem);
  EXPECT_EQ(estimate.verdict, Verdict::kNotLocated);
  EXPECT_NE(estimate.reason.find("no world is known"), std::string::npos) << estimate.reason;
}

TEST(Multipath, BadOptionsAreErrors) {
  EXPECT_THROW(multipath_method({.min_directness = 0.0}), Error);
  EXPECT_THROW(multipath_method({.rounds = 0}), Error);
}

}  // namespace
}  // namespace tagfield
