// SPDX-License-Identifier: Apache-2.0
#include "tagfield/tracking/tracker.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>

#include "tagfield/tracking/test/made_pass.h"

namespace tagfield {
namespace {

constexpr double kBeltHeight = 0.8;

TrackingOptions belt_options() {
  TrackingOptions options;
  options.lane = Lane{};
  return options;
}

using Motions = std::map<std::string, made::Motion>;

/// Tags 0.2 m apart along x, with random lateral offsets of a few cm, each moving through the gate.
struct Belt {
  std::vector<TagRead> reads;
  Motions truth;
};

Belt belt_of(unsigned seed, double speed_m_s, const made::Gate& gate, int tags) {
  made::Rng rng(seed);
  Belt belt;
  for (int i = 0; i < tags; ++i) {
    const std::string tag = "tag" + std::to_string(10 + i);
    const double away = made::normal(rng, 0.04);
    belt.truth[tag] = made::straight({-0.2 * i, away, kBeltHeight}, {speed_m_s, 0.0, 0.0});
    const double time = 8.0 / speed_m_s + 3.0;
    made::read_motion(gate, tag, belt.truth[tag], -time, time, rng, belt.reads);
  }
  return belt;
}

std::vector<TagTrack> tracks_of(const made::Gate& gate, const std::vector<TagRead>& reads,
                                const TrackingOptions& options, int threads = 1) {
  Diagnostics diagnostics;
  return track_tags(made::problem_of(gate, reads, kBeltHeight), options, threads, diagnostics);
}

double along_error(const Track& track, const made::Motion& truth) {
  double sum = 0.0;
  for (const TrackPoint& point : track.points) {
    sum += std::abs(point.p_WT.x() - truth(made::seconds_of(point.stamp)).x());
  }
  return sum / static_cast<double>(track.points.size());
}

struct Case {
  const char* name;
  double speed_m_s = 1.0;
  made::Gate gate;
  TrackMethod method = TrackMethod::kEkf;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  const auto add = [&](const char* name, double speed, const auto& change) {
    Case one{name, speed, {}, TrackMethod::kEkf};
    change(one);
    all.push_back(one);
  };
  add("15 Hz", 1.0, [](Case&) {});
  add("60 Hz", 1.0, [](Case& one) { one.gate.rate_hz = 60.0; });
  add("2 m/s", 2.0, [](Case&) {});
  add("30 % lost", 1.0, [](Case& one) { one.gate.lost = 0.3; });
  add("above", 1.0, [](Case& one) { one.gate.antennas = {{-0.5, 0.2, 2.0}, {0.5, -0.2, 2.0}}; });
  add("portal", 1.0, [](Case& one) { one.gate.antennas = {{0.0, 1.5, 1.2}, {0.0, -1.5, 1.2}}; });
  add("ETSI channels", 1.0, [](Case& one) {
    one.gate.channels_hz = {865.7e6, 866.3e6, 866.9e6, 867.5e6};
    one.gate.rate_hz = 30.0;
  });
  add("pi ambiguity", 1.0, [](Case& one) {
    one.gate.pi_ambiguity = true;
    one.gate.rate_hz = 30.0;
  });
  add("128 steps", 1.0, [](Case& one) { one.gate.phase_step_rad = kTwoPi / 128.0; });
  add("unscented", 1.0, [](Case& one) { one.method = TrackMethod::kUkf; });
  return all;
}

TEST(Tracker, FollowsTagsOnABeltAndTellsTheirOrder) {
  for (const Case& one : cases()) {
    SCOPED_TRACE(one.name);
    TrackingOptions options = belt_options();
    options.method = one.method;
    const Belt belt = belt_of(7, one.speed_m_s, one.gate, 6);
    const auto tracks = tracks_of(one.gate, belt.reads, options);
    double sum = 0.0;
    for (const TagTrack& tag : tracks) {
      ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
      sum += along_error(tag.tracks.front(), belt.truth.at(tag.tag)) / 6.0;
    }
    EXPECT_LT(sum, 0.02);
    const auto orders = passing_orders(made::problem_of(one.gate, belt.reads, kBeltHeight), tracks,
                                       PassingLine{{0.0, 0.0}, kPi / 2.0});
    ASSERT_EQ(orders.size(), 1U + one.gate.antennas.size());
    for (const PassingOrder& order : orders) {
      ASSERT_EQ(order.passings.size(), 6U);
      for (std::size_t i = 0; i < 6; ++i) {
        EXPECT_EQ(order.passings[i].tag, "tag" + std::to_string(10 + i)) << order.name;
      }
    }
  }
}

TEST(Tracker, OfManyNoisyTagsTheOrderIsRight) {
  made::Gate gate;
  gate.noise_rad = 0.3;
  std::size_t pairs = 0;
  std::size_t wrong = 0;
  double sum = 0.0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    const Belt belt = belt_of(seed, 1.0, gate, 6);
    const auto tracks = tracks_of(gate, belt.reads, belt_options());
    for (const TagTrack& tag : tracks) {
      ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
      sum += along_error(tag.tracks.front(), belt.truth.at(tag.tag)) / 36.0;
    }
    const auto orders = passing_orders(made::problem_of(gate, belt.reads, kBeltHeight), tracks,
                                       PassingLine{{0.0, 0.0}, kPi / 2.0});
    for (std::size_t i = 1; i < orders.front().passings.size(); ++i, ++pairs) {
      if (orders.front().passings[i].tag < orders.front().passings[i - 1].tag) ++wrong;
    }
  }
  EXPECT_EQ(pairs, 30U);
  EXPECT_EQ(wrong, 0U);
  EXPECT_LT(sum, 0.03);
}

TEST(Tracker, CovariancesAreHonest) {
  // Tags that follow the model exactly: white acceleration of this density.
  constexpr double kNoise = 0.02;
  constexpr int kTracks = 50;
  TrackingOptions options = belt_options();
  options.acceleration_noise = kNoise;
  options.lane->lateral_sigma_m = 0.5;
  options.lane->heading_sigma_rad = 0.5;
  made::Gate gate;
  gate.rate_hz = 30.0;
  double sum = 0.0;
  int tracked = 0;
  for (unsigned seed = 1; seed <= kTracks; ++seed) {
    made::Rng rng(seed);
    std::vector<Eigen::Vector3d> places;
    Eigen::Vector3d p(-5.0, 0.0, kBeltHeight);
    Eigen::Vector3d v(1.0, 0.0, 0.0);
    constexpr double kStep = 0.01;
    for (int i = 0; i <= 1200; ++i) {
      places.push_back(p);
      const Eigen::Vector3d kick(made::normal(rng, kNoise * std::sqrt(kStep)),
                                 made::normal(rng, kNoise * std::sqrt(kStep)), 0.0);
      p += kStep * (v + 0.5 * kick);
      v += kick;
    }
    const made::Motion motion = [&](double t) -> Eigen::Vector3d {
      const double place = std::clamp(t / kStep, 0.0, 1199.0);
      const auto i = static_cast<std::size_t>(place);
      const double part = place - static_cast<double>(i);
      return (1.0 - part) * places[i] + part * places[i + 1];
    };
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", motion, 0.0, 12.0, rng, reads);
    const auto tracks = tracks_of(gate, reads, options);
    // Some of these tags turn so far that they cannot be distinguished from their mirror image.
    if (tracks.front().verdict != TrackVerdict::kTracked) continue;
    ++tracked;
    const auto& points = tracks.front().tracks.front().points;
    const TrackPoint& middle = points[points.size() / 2];
    const Eigen::Vector2d error = (middle.p_WT - motion(made::seconds_of(middle.stamp))).head<2>();
    const Eigen::Matrix2d covariance = middle.covariance.topLeftCorner<2, 2>();
    sum += error.dot(covariance.ldlt().solve(error));
  }
  EXPECT_GE(tracked, 48);
  // χ² of 96 to 100 degrees of freedom lies between 70.8 and 129.6 in 95 % of cases.
  EXPECT_GT(sum, 70.8);
  EXPECT_LT(sum, 129.6);
}

/// Largest distance from the truth, seen from above, in standard deviations of the track.
double worst_sigmas(const Track& track, const made::Motion& truth) {
  double worst = 0.0;
  for (const TrackPoint& point : track.points) {
    const Eigen::Vector2d error = (point.p_WT - truth(made::seconds_of(point.stamp))).head<2>();
    const Eigen::Matrix2d covariance = point.covariance.topLeftCorner<2, 2>();
    worst = std::max(worst, std::sqrt(error.dot(covariance.ldlt().solve(error))));
  }
  return worst;
}

TEST(Tracker, TagsThatSpeedUpAreTrackedWithLargerErrors) {
  // From 0.8 to 1.2 m/s within two seconds, which white acceleration of the default density reaches
  // in 57 standard deviations.
  const made::Motion truth = [](double t) -> Eigen::Vector3d {
    const double within = std::clamp(t, -1.0, 1.0);
    const double x = within + 0.1 * within * within + (t < within ? 0.8 : 1.2) * (t - within);
    return {x, 0.02, kBeltHeight};
  };
  made::Gate gate;
  gate.rate_hz = 30.0;
  gate.antennas.push_back({0.0, -1.5, 1.2});
  for (unsigned seed = 1; seed <= 4; ++seed) {
    made::Rng rng(seed);
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", truth, -10.0, 5.0, rng, reads);
    const TagTrack tag = tracks_of(gate, reads, belt_options()).front();
    ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
    EXPECT_GT(tag.tracks.front().acceleration_noise, 0.01);
    EXPECT_EQ(tag.reason.rfind("it accelerated, or reflections shift its phases: ", 0), 0U)
        << tag.reason;
    EXPECT_LT(worst_sigmas(tag.tracks.front(), truth), 5.0);
    EXPECT_LT(along_error(tag.tracks.front(), truth), 0.03);
    TrackingOptions stated = belt_options();
    stated.lane->acceleration_noise = tag.tracks.front().acceleration_noise;
    const TagTrack as_stated = tracks_of(gate, reads, stated).front();
    ASSERT_EQ(as_stated.verdict, TrackVerdict::kTracked) << as_stated.reason;
    EXPECT_EQ(as_stated.reason, "");
    EXPECT_LT(as_stated.tracks.front().expected_error_m, tag.tracks.front().expected_error_m);
  }
}

/// Brakes from 1 m/s to 0 in half a second at t = −0.5, and starts again in as much at t = 2.
Eigen::Vector3d of_a_belt_that_stops(double t) {
  const double braking = std::clamp(t + 0.5, 0.0, 0.5);
  const double starting = std::clamp(t - 2.0, 0.0, 0.5);
  const double x = std::min(t + 0.5, 0.0) + braking - braking * braking + starting * starting +
                   std::max(t - 2.5, 0.0);
  return {x, 0.02, kBeltHeight};
}

TEST(Tracker, ABeltMayStop) {
  made::Gate gate;
  gate.rate_hz = 30.0;
  for (unsigned seed = 1; seed <= 6; ++seed) {
    made::Rng rng(seed);
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", of_a_belt_that_stops, -5.0, 8.0, rng, reads);
    const TagTrack tag = tracks_of(gate, reads, belt_options()).front();
    ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
    EXPECT_LT(along_error(tag.tracks.front(), of_a_belt_that_stops), 0.02);
    EXPECT_LT(worst_sigmas(tag.tracks.front(), of_a_belt_that_stops), 5.0);
    TrackingOptions stated = belt_options();
    stated.lane->acceleration_noise = 0.5;
    const TagTrack as_stated = tracks_of(gate, reads, stated).front();
    ASSERT_EQ(as_stated.verdict, TrackVerdict::kTracked) << as_stated.reason;
    EXPECT_EQ(as_stated.reason, "");
    EXPECT_LT(along_error(as_stated.tracks.front(), of_a_belt_that_stops), 0.02);
  }
}

TEST(Tracker, TagsThatStopAreNotPutElsewhere) {
  const made::Motion truth = [](double t) -> Eigen::Vector3d {
    return {t < 0.0 ? t : std::max(0.0, t - 3.0), 0.0, kBeltHeight};
  };
  made::Gate gate;
  gate.rate_hz = 30.0;
  gate.antennas.push_back({0.0, -1.5, 1.2});
  for (unsigned seed = 1; seed <= 4; ++seed) {
    made::Rng rng(seed);
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", truth, -6.0, 9.0, rng, reads);
    const TagTrack tag = tracks_of(gate, reads, {}).front();
    if (tag.verdict == TrackVerdict::kNotTracked) {
      EXPECT_EQ(tag.reason.rfind("cannot track: ", 0), 0U);
    } else {
      EXPECT_LT(worst_sigmas(tag.tracks.front(), truth), 6.0) << seed;
    }
  }
}

TEST(Tracker, SlowPhaseErrorsWidenTheCovariances) {
  // Errors with a correlation of 0.9 from read to read, as by reflections: 19 of them count as one.
  constexpr double kKept = 0.9;
  constexpr double kSigma = 0.2;
  constexpr int kTracks = 40;
  made::Gate gate;
  gate.noise_rad = 0.02;
  gate.rate_hz = 30.0;
  gate.antennas.push_back({0.0, -1.5, 1.2});
  TrackingOptions options = belt_options();
  options.lane->lateral_sigma_m = 0.5;
  double sum = 0.0;
  int tracked = 0;
  for (unsigned seed = 1; seed <= kTracks; ++seed) {
    made::Rng rng(seed);
    const made::Motion truth = made::straight({0.0, 0.1, kBeltHeight}, {1.0, 0.0, 0.0});
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", truth, -5.0, 5.0, rng, reads);
    std::map<std::string, double> error;
    for (TagRead& read : reads) {
      double& e = error[read.antenna];
      e = kKept * e + made::normal(rng, kSigma * std::sqrt(1.0 - kKept * kKept));
      read.phase_rad = wrap_to_two_pi(read.phase_rad + e);
    }
    const TagTrack tag = tracks_of(gate, reads, options).front();
    if (tag.verdict != TrackVerdict::kTracked) continue;
    ++tracked;
    const auto& points = tag.tracks.front().points;
    const TrackPoint& middle = points[points.size() / 2];
    const Eigen::Vector2d off = (middle.p_WT - truth(made::seconds_of(middle.stamp))).head<2>();
    const Eigen::Matrix2d covariance = middle.covariance.topLeftCorner<2, 2>();
    sum += off.dot(covariance.ldlt().solve(off));
  }
  EXPECT_GE(tracked, 30);
  // The expectation is 2 a track if the covariances are right. Counted as independent reads it
  // was 33.
  EXPECT_LT(sum / tracked, 3.0);
}

/// Adds `jump_rad` to the phases of an antenna every `period_s`, of each at other times.
void make_jump(double jump_rad, double period_s, double apart_s, std::vector<TagRead>& reads) {
  for (TagRead& read : reads) {
    const int antenna = read.antenna.back() - '0';
    const double jumps =
        std::floor((made::seconds_of(read.stamp) + 100.0 + apart_s * antenna) / period_s);
    read.phase_rad = wrap_to_two_pi(read.phase_rad + jump_rad * jumps);
  }
}

TEST(Tracker, PhasesThatJumpAgainAndAgainAreNoTrack) {
  made::Gate gate;
  gate.rate_hz = 30.0;
  gate.antennas.push_back({0.0, -1.5, 1.2});
  Belt belt = belt_of(3, 1.0, gate, 1);
  make_jump(2.6, 2.5, 0.37, belt.reads);
  const TagTrack tag = tracks_of(gate, belt.reads, belt_options()).front();
  EXPECT_EQ(tag.verdict, TrackVerdict::kNotTracked);
  EXPECT_EQ(tag.reason.rfind("cannot track: its phases jump ", 0), 0U) << tag.reason;
}

TEST(Tracker, WhatOnlyViolentMotionExplainsIsNoTrack) {
  made::Gate gate;
  gate.rate_hz = 30.0;
  Belt belt = belt_of(3, 1.0, gate, 1);
  make_jump(2.0, 1.0, 0.0, belt.reads);
  const TagTrack tag = tracks_of(gate, belt.reads, belt_options()).front();
  EXPECT_EQ(tag.verdict, TrackVerdict::kNotTracked);
  EXPECT_EQ(tag.reason.rfind("cannot track: it changes its motion too much: ", 0), 0U)
      << tag.reason;
}

TEST(Tracker, AnUnknownHeightWidensAcrossTheLane) {
  // Seen from antennas of its own height, a tag 0.4 m higher looks 5 cm further away, and nothing
  // tells one from the other but the lane.
  made::Gate gate;
  gate.antennas = {{-0.5, 1.5, 1.2}, {0.5, 1.5, 1.2}};
  gate.rate_hz = 30.0;
  TrackingOptions options = belt_options();
  options.unknown_height_sigma_m = 0.3;
  for (const double above : {-0.4, 0.0, 0.4}) {
    made::Rng rng(4);
    const made::Motion truth = made::straight({0.0, 0.0, 1.2 + above}, {1.0, 0.0, 0.0});
    std::vector<TagRead> reads;
    made::read_motion(gate, "tag", truth, -5.0, 5.0, rng, reads);
    LocalizationProblem problem = made::problem_of(gate, reads, 1.2);
    problem.heights.of_all.reset();
    Diagnostics diagnostics;
    const TagTrack tag = track_tags(problem, options, 1, diagnostics).front();
    ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
    EXPECT_LT(worst_sigmas(tag.tracks.front(), truth), 3.0) << above;
  }
}

TEST(Tracker, WhereFewParticlesLoseATagTheErrorSaysSo) {
  const made::Gate gate;
  TrackingOptions options = belt_options();
  options.method = TrackMethod::kParticle;
  options.particles = 100;
  options.max_expected_error_m = 10.0;
  options.min_coherence = 0.01;
  const Belt belt = belt_of(8, 1.0, gate, 6);
  double largest = 0.0;
  for (const TagTrack& tag : tracks_of(gate, belt.reads, options)) {
    ASSERT_FALSE(tag.tracks.empty()) << tag.reason;
    const Track& track = tag.tracks.front();
    for (const TrackPoint& point : track.points) {
      const Eigen::Vector3d error =
          point.p_WT - belt.truth.at(tag.tag)(made::seconds_of(point.stamp));
      largest = std::max(largest, error.norm());
      if (error.norm() < 0.1) continue;
      Track here = track;
      here.points = {point};
      EXPECT_LT(worst_sigmas(here, belt.truth.at(tag.tag)), 5.0) << error.transpose();
    }
  }
  EXPECT_GT(largest, 0.3);  // Some were lost.
}

TEST(Tracker, MirrorImagesAreGivenWhereNothingTellsThem) {
  const made::Gate gate;
  const Belt belt = belt_of(3, 1.0, gate, 1);
  TrackingOptions options;
  options.max_speed_m_s = 2.0;
  const auto tracks = tracks_of(gate, belt.reads, options);
  ASSERT_EQ(tracks.front().verdict, TrackVerdict::kAmbiguous);
  ASSERT_EQ(tracks.front().tracks.size(), 2U);
  // On the other side of the plane y = 1.5, which contains both antennas.
  const auto& a = tracks.front().tracks[0].points;
  const auto& b = tracks.front().tracks[1].points;
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].p_WT.y() + b[i].p_WT.y(), 3.0, 1e-3);
    EXPECT_NEAR(a[i].p_WT.x(), b[i].p_WT.x(), 1e-3);
  }
}

TEST(Tracker, AThirdAntennaElsewhereTellsMirrorImages) {
  made::Gate gate;
  gate.antennas.push_back({0.0, -1.5, 1.2});
  const Belt belt = belt_of(3, 1.0, gate, 1);
  TrackingOptions options;
  options.max_speed_m_s = 2.0;
  const auto tracks = tracks_of(gate, belt.reads, options);
  ASSERT_EQ(tracks.front().verdict, TrackVerdict::kTracked) << tracks.front().reason;
  EXPECT_LT(along_error(tracks.front().tracks.front(), belt.truth.at("tag10")), 0.02);
}

TEST(Tracker, AntennasOnARobotFollowATagToo) {
  // Only the tag's motion relative to the antenna matters, but positions are in the world frame.
  made::Rng rng(4);
  const made::Motion robot = made::straight({0.0, 1.6, 1.0}, {-0.3, 0.0, 0.0});
  const made::Motion truth = made::straight({0.0, 0.0, kBeltHeight}, {0.7, 0.0, 0.0});
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
  for (int i = -120; i <= 120; ++i) {
    const double t = i / 30.0;
    const Time stamp = time_from_seconds(100.0 + t);
    const double r = (truth(t) - robot(t)).norm();
    const double phase = 2.0 * kTwoPi / wavelength(865.7e6) * r + 1.0 + made::normal(rng, 0.1);
    reads.push_back({stamp, "reader", "gate1", "tag", 865.7e6, wrap_to_two_pi(phase), -50.0});
    poses.push_back({stamp, "gate1", from_translation(robot(t))});
  }
  KnownBeforehand known;
  known.heights.of_all = kBeltHeight;
  known.pi_ambiguity = false;
  Diagnostics diagnostics;
  const auto problem = make_problem(reads, poses, known, diagnostics);
  const auto tracks = track_tags(problem, belt_options(), 1, diagnostics);
  ASSERT_EQ(tracks.front().verdict, TrackVerdict::kTracked) << tracks.front().reason;
  EXPECT_LT(along_error(tracks.front().tracks.front(), truth), 0.02);
}

TEST(Tracker, SaysWhyNotAndGoesOnWithTheOthers) {
  const made::Gate gate;
  Belt belt = belt_of(5, 1.0, gate, 1);
  made::Rng rng(6);
  belt.reads.push_back(belt.reads.front());
  belt.reads.back().tag = "once";
  std::vector<TagRead> noise = belt.reads;
  for (TagRead& read : noise) {
    read.tag = "noise";
    read.phase_rad = made::uniform(rng, 0.0, kTwoPi);
  }
  belt.reads.insert(belt.reads.end(), noise.begin(), noise.end());
  made::read_motion(gate, "rests", made::straight({0.0, 0.0, kBeltHeight}, {0.0, 0.0, 0.0}), -3.0,
                    3.0, rng, belt.reads);
  std::reverse(belt.reads.begin(), belt.reads.end());
  const auto tracks = tracks_of(gate, belt.reads, belt_options());
  ASSERT_EQ(tracks.size(), 4U);
  std::map<std::string, TagTrack> by_tag;
  for (const TagTrack& tag : tracks) by_tag[tag.tag] = tag;
  EXPECT_EQ(by_tag["once"].reason, "cannot track: 1 usable read, at least 12 are needed");
  for (const char* tag : {"once", "noise", "rests"}) {
    EXPECT_EQ(by_tag[tag].verdict, TrackVerdict::kNotTracked) << tag;
    EXPECT_EQ(by_tag[tag].reason.rfind("cannot track: ", 0), 0U) << by_tag[tag].reason;
    EXPECT_TRUE(by_tag[tag].tracks.empty());
  }
  EXPECT_EQ(by_tag["tag10"].verdict, TrackVerdict::kTracked) << by_tag["tag10"].reason;
}

/// Pieces of passes; if `at_random`, every phase is replaced by a random one.
std::vector<TagRead> pieces(int tags, double seconds, bool at_random) {
  made::Rng rng(5);
  std::vector<TagRead> reads;
  for (int i = 0; i < tags; ++i) {
    const double begin = made::uniform(rng, -2.0, 2.0 - seconds);
    made::read_motion({}, "tag" + std::to_string(100 + i),
                      made::straight({0, 0, kBeltHeight}, {1, 0, 0}), begin, begin + seconds, rng,
                      reads);
  }
  for (TagRead& read : reads) {
    if (at_random) read.phase_rad = made::uniform(rng, 0.0, kTwoPi);
  }
  return reads;
}

int claims(const std::vector<TagTrack>& tracks) {
  return static_cast<int>(std::count_if(tracks.begin(), tracks.end(), [](const TagTrack& track) {
    return track.verdict != TrackVerdict::kNotTracked;
  }));
}

// A piece of half a second has 14 or 15 reads: without a lane, most random phases can be explained
// by some motion.
TEST(Tracker, RandomPhasesMakeNoTracks) {
  TrackingOptions free;
  for (const double seconds : {0.5, 1.0}) {
    const std::vector<TagRead> reads = pieces(40, seconds, true);
    EXPECT_LE(claims(tracks_of({}, reads, belt_options())), 1) << seconds << " s, with a lane";
    EXPECT_LE(claims(tracks_of({}, reads, free)), 1) << seconds << " s, without";
  }
  EXPECT_GE(claims(tracks_of({}, pieces(20, 0.8, false), belt_options())), 19) << "of true phases";
}

TEST(Tracker, OfTwoPassesTheLongerIsFollowed) {
  const made::Gate gate;
  Belt belt = belt_of(5, 1.0, gate, 1);
  TagRead late = belt.reads.front();
  late.stamp += duration_from_seconds(60.0);
  belt.reads.push_back(late);
  const auto tracks = tracks_of(gate, belt.reads, belt_options());
  EXPECT_EQ(tracks.front().verdict, TrackVerdict::kTracked);
  EXPECT_EQ(tracks.front().reason, "left out beyond a gap in time: 1 reads");
}

TEST(Tracker, ThreadsAndTheOrderOfReadsChangeNothing) {
  const made::Gate gate;
  for (const TrackMethod method : {TrackMethod::kEkf, TrackMethod::kParticle}) {
    TrackingOptions options = belt_options();
    options.method = method;
    options.min_coherence = 0.05;  // So few particles track poorly.
    options.max_expected_error_m = 10.0;
    options.particles = 300;
    Belt belt = belt_of(8, 1.0, gate, 2);
    const auto one = tracks_of(gate, belt.reads, options, 1);
    std::reverse(belt.reads.begin(), belt.reads.end());
    const auto three = tracks_of(gate, belt.reads, options, 3);
    ASSERT_EQ(one.size(), three.size());
    for (std::size_t i = 0; i < one.size(); ++i) {
      ASSERT_EQ(one[i].verdict, three[i].verdict);
      ASSERT_FALSE(one[i].tracks.empty());
      EXPECT_EQ(one[i].tracks.front().points.back().p_WT,
                three[i].tracks.front().points.back().p_WT);
    }
  }
}

TEST(Tracker, ParticlesFollowTheBeltToo) {
  made::Gate gate;
  gate.antennas = {{-0.5, 0.2, 2.0}, {0.5, -0.2, 2.0}};
  TrackingOptions options = belt_options();
  options.method = TrackMethod::kParticle;
  const Belt belt = belt_of(9, 1.0, gate, 2);
  for (const TagTrack& tag : tracks_of(gate, belt.reads, options)) {
    ASSERT_EQ(tag.verdict, TrackVerdict::kTracked) << tag.reason;
    EXPECT_LT(along_error(tag.tracks.front(), belt.truth.at(tag.tag)), 0.03);
  }
}

TEST(TrackingOptions, OutOfRangeAreErrors) {
  TrackingOptions options;
  options.min_speed_m_s = 4.0;
  EXPECT_THROW(check(options), Error);
  options = {};
  options.acceleration_noise = std::nan("");
  EXPECT_THROW(check(options), Error);
  options = {};
  options.lane = Lane{};
  options.lane->lateral_sigma_m = 0.0;
  EXPECT_THROW(check(options), Error);
  EXPECT_THROW(static_cast<void>(track_method("kalman")), Error);
}

}  // namespace
}  // namespace tagfield
