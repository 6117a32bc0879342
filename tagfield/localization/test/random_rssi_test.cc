// SPDX-License-Identifier: Apache-2.0
/// How often `trilateration` claims wrong positions, and whether its expected errors are right, on
/// random surveys by RSSI: paths of five kinds, one or two antennas, lobes and dipoles that nobody
/// states, slopes from 30 to 50 dB, obstacles, noise. More of them:
///
///     TAGFIELD_SURVEYS=100 build/release/bin/localization_test --gtest_filter='RandomRssi.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <string>
#include <vector>

#include "method_study.h"
#include "tagfield/localization/signal_strength/trilateration.h"

namespace tagfield::made {
namespace {

/// What nobody states about a survey.
struct Hidden {
  double slope_db = 40.0;
  double lobe_db = 0.0;    ///< Two-way loss opposite to an antenna's boresight; 0: isotropic.
  double dipole_db = 0.0;  ///< Two-way loss along a tag's axis; 0: isotropic.
  double obstacles_db = 0.0;
  double noise_db = 1.0;
};

/// Two-way gain of a dipole [dB]: cos² of the angle from its equator, squared for there and back,
/// down to a floor.
double dipole_gain(const Eigen::Vector3d& axis, const Eigen::Vector3d& u, double floor_db) {
  const double sine2 = 1.0 - std::pow(axis.dot(u), 2);
  return std::max(20.0 * std::log10(std::max(sine2, 1e-9)), -floor_db);
}

/// Two-way gain of an antenna [dB] that falls from its boresight to the opposite direction.
double lobe_gain(const Eigen::Vector3d& boresight, const Eigen::Vector3d& u, double back_db) {
  const double front = 0.5 + 0.5 * boresight.dot(u);  // 1 to 0.
  return std::max(back_db * 0.8 * std::log10(std::max(front, 1e-9)), -back_db);
}

Eigen::Vector3d direction_of_any_tag(Rng& rng) {
  Eigen::Vector3d u;
  for (Eigen::Index k = 0; k < 3; ++k) u[k] = normal(rng, 1.0);
  return u.normalized();
}

double travel_heading(const Path& path, std::size_t i) {
  const Eigen::Vector3d step = path[std::min(i + 1, path.size() - 1)] - path[i > 0 ? i - 1 : 0];
  return std::atan2(step.y(), step.x());
}

Path rssi_path(Rng& rng) {
  const double length = uniform(rng, 8.0, 22.0);
  const double first = uniform(rng, 1.0, 4.0);
  const double second = uniform(rng, 1.0, 4.0);
  switch (static_cast<int>(uniform(rng, 0.0, 5.0))) {
    case 0:
      return s_curve(length, 0.02);
    case 1:
      return loop(length, 0.02);
    case 2:
      return l_turn(0.4 * length, 0.5 * length, 0.02);
    case 3:
      return rectangle(first, second, length, 0.02);
    default:
      return aisles(0.02);
  }
}

struct Obstacle {
  Eigen::Vector2d p_W;
  double radius_m = 0.0;
};

/// Whether a ray passes over an obstacle.
bool hides_the_tag(const Obstacle& obstacle, const Eigen::Vector3d& from,
                   const Eigen::Vector3d& to) {
  const Eigen::Vector2d way = (to - from).head<2>();
  const double share =
      std::clamp((obstacle.p_W - from.head<2>()).dot(way) / way.squaredNorm(), 0.0, 1.0);
  return (from.head<2>() + share * way - obstacle.p_W).norm() < obstacle.radius_m;
}

struct RssiSurvey {
  LocalizationProblem problem;
  std::map<std::string, Eigen::Vector3d> truth;
};

RssiSurvey make_rssi_survey(const Hidden& hidden, Rng& rng) {
  const Path path = rssi_path(rng);
  const double range_m = uniform(rng, 4.0, 8.0);
  std::vector<double> mounted_at{uniform(rng, -kPi, kPi)};
  if (uniform(rng, 0.0, 1.0) < 0.4) mounted_at.push_back(mounted_at[0] + kPi);
  std::vector<Obstacle> obstacles;
  for (int k = 0; k < 4; ++k) {
    const Eigen::Vector3d p_W = beside(path, uniform(rng, 0.4, 2.0), 0.0, rng);
    obstacles.push_back({p_W.head<2>(), uniform(rng, 0.1, 0.4)});
  }
  RssiSurvey survey;
  const double level_dbm = uniform(rng, -35.0, -25.0);
  for (std::size_t a = 0; a < mounted_at.size(); ++a) {
    BelievedTrack& track = survey.problem.tracks["antenna" + std::to_string(a)];
    for (std::size_t i = 0; i < path.size(); ++i) {
      const double yaw = travel_heading(path, i) + mounted_at[a];
      track.X_WA.push_back(
          {time_from_seconds(static_cast<double>(i) / 15.0),
           {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), path[i]}});
    }
  }
  for (int k = 0; k < 6; ++k) {
    const std::string tag = "tag" + std::to_string(k);
    const double height = uniform(rng, 0.3, 1.6);
    const Eigen::Vector3d p_WT = beside(path, uniform(rng, 0.8, 4.0), height, rng);
    const Eigen::Vector3d axis = direction_of_any_tag(rng);
    survey.truth[tag] = p_WT;
    survey.problem.heights.of_tag[tag] = height;
    for (const auto& [antenna, track] : survey.problem.tracks) {
      for (const StampedPose& pose : track.X_WA) {
        const Eigen::Vector3d p_WA = pose.X_WB.translation;
        const double r = (p_WT - p_WA).norm();
        if (r > range_m || uniform(rng, 0.0, 1.0) < 0.3) continue;
        const Eigen::Vector3d u = (p_WT - p_WA) / r;
        double rssi = level_dbm - hidden.slope_db * std::log10(r) +
                      lobe_gain(pose.X_WB.rotation * Eigen::Vector3d::UnitX(), u, hidden.lobe_db) +
                      dipole_gain(axis, u, hidden.dipole_db);
        for (const Obstacle& obstacle : obstacles)
          if (hides_the_tag(obstacle, p_WA, p_WT)) rssi -= hidden.obstacles_db;
        PhaseSample sample;
        sample.stamp = pose.stamp;
        sample.frequency_hz = 865.7e6;
        sample.p_WA = p_WA;
        sample.rssi_dbm = std::round(rssi + normal(rng, hidden.noise_db));
        survey.problem.samples[tag][antenna].push_back(sample);
      }
    }
  }
  return survey;
}

unsigned count_of_rssi_surveys() {
  constexpr unsigned kUsual = 4;
  const char* const asked = std::getenv("TAGFIELD_SURVEYS");
  return asked == nullptr ? kUsual : static_cast<unsigned>(std::max(1, std::atoi(asked)));
}

struct RssiClaims {
  int tags = 0;
  int located = 0;
  int ambiguous = 0;
  int false_ones = 0;    ///< Over three times the expected error off.
  double squares = 0.0;  ///< Σ (error/expected)².
};

RssiClaims claims_of(Hidden hidden) {
  RssiClaims claims;
  for (unsigned seed = 1; seed <= count_of_rssi_surveys(); ++seed) {
    Rng rng(seed);
    hidden.slope_db = uniform(rng, 30.0, 50.0);
    const RssiSurvey survey = make_rssi_survey(hidden, rng);
    Diagnostics diagnostics;
    for (const TagEstimate& estimate :
         trilateration_method().locate(survey.problem, 1, diagnostics).estimates) {
      ++claims.tags;
      if (estimate.verdict == Verdict::kAmbiguous) ++claims.ambiguous;
      if (estimate.verdict != Verdict::kLocated) continue;
      ++claims.located;
      const Candidate& best = estimate.candidates.front();
      const double error = level_error(best, survey.truth.at(estimate.tag));
      claims.squares += std::pow(error / best.expected_error_m, 2);
      if (error > 3.0 * best.expected_error_m) ++claims.false_ones;
    }
  }
  return claims;
}

struct RssiCase {
  const char* name;
  Hidden hidden;
};

const RssiCase kCases[] = {
    {"isotropic", {.noise_db = 1.0}},
    {"isotropic, 3 dB of noise", {.noise_db = 3.0}},
    {"obstacles", {.obstacles_db = 5.0}},
    {"dipoles", {.dipole_db = 10.0}},
    {"lobes", {.lobe_db = 20.0}},
    {"lobes and dipoles", {.lobe_db = 20.0, .dipole_db = 20.0, .noise_db = 2.0}},
    {"sharp lobes and dipoles, obstacles",
     {.lobe_db = 40.0, .dipole_db = 30.0, .obstacles_db = 5.0}}};

TEST(RandomRssi, ExpectedErrorsHoldWhateverTheGains) {
  int located = 0;
  int tags = 0;
  for (const RssiCase& one : kCases) {
    const RssiClaims claims = claims_of(one.hidden);
    const double calibration = std::sqrt(claims.squares / std::max(1, claims.located));
    fmt::print("{}: {} tags, {} ambiguous, {} located, {} of them falsely; error/expected {:.2f}\n",
               one.name, claims.tags, claims.ambiguous, claims.located, claims.false_ones,
               calibration);
    EXPECT_LE(claims.false_ones, 1 + claims.located / 10) << one.name;
    EXPECT_LT(calibration, 2.5) << one.name;
    located += claims.located;
    tags += claims.tags;
  }
  EXPECT_GE(8 * located, tags);
}

}  // namespace
}  // namespace tagfield::made
