// SPDX-License-Identifier: Apache-2.0
/// How often tags are claimed to have moved where they did not, on random passes: one to four
/// antennas beside, around or above, with a lane or without, 1 to 8 channels, and with some chance
/// a π ambiguity and lost reads. Tags go straight, accelerate by the model, change their speed,
/// stop, or turn; phases are disturbed by a floor or arbitrary ones, or the height is unknown. More
/// of them:
///
///     TAGFIELD_PASSES=800 build/release/bin/tracking_test --gtest_filter='RandomPasses.*'
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <complex>
#include <cstdlib>

#include "tagfield/tracking/test/made_pass.h"
#include "tagfield/tracking/tracker.h"

namespace tagfield::made {
namespace {

enum class Moves { kStraight, kByTheModel, kFaster, kStops, kTurns, kTurnsSharply };
enum class Disturbance { kNone, kFloor, kStrays, kUnknownHeight };

bool happens(double chance, Rng& rng) { return uniform(rng, 0.0, 1.0) < chance; }

int any_of(int count, Rng& rng) { return static_cast<int>(uniform(rng, 0.0, count)); }

std::vector<Eigen::Vector3d> any_antennas(Rng& rng) {
  const int count = 1 + any_of(4, rng);
  const int layout = any_of(4, rng);
  const double height = uniform(rng, 0.8, 2.5);
  const double step = uniform(rng, 0.5, 1.2);
  std::vector<Eigen::Vector3d> antennas;
  for (int i = 0; i < count; ++i) {
    const double x = step * (i - 0.5 * (count - 1));
    const double side = i % 2 == 0 ? 1.0 : -1.0;
    Eigen::Vector3d p(x, 1.5, height);
    if (layout == 1) p = {x, side * uniform(rng, 1.0, 1.8), height + 0.3 * (i / 2)};
    if (layout == 2) p = {x, 0.3 * side, uniform(rng, 2.0, 2.6)};
    if (layout == 3) {
      for (const auto& [axis, low, high] :
           {std::tuple(0, -1.5, 1.5), std::tuple(1, -2.0, 2.0), std::tuple(2, 0.5, 2.5)}) {
        p(axis) = uniform(rng, low, high);
      }
    }
    antennas.push_back(p);
  }
  return antennas;
}

Gate any_gate(Rng& rng) {
  Gate gate;
  gate.antennas = any_antennas(rng);
  gate.rate_hz = uniform(rng, 12.0, 50.0);
  gate.range_m = uniform(rng, 2.0, 5.0);
  gate.noise_rad = uniform(rng, 0.05, 0.35);
  gate.lost = happens(0.5, rng) ? uniform(rng, 0.0, 0.4) : 0.0;
  const int channels = happens(0.3, rng) ? 4 * (1 + any_of(2, rng)) : 1;
  gate.channels_hz.clear();
  for (int i = 0; i < channels; ++i) gate.channels_hz.push_back(865.7e6 + 0.6e6 * i);
  gate.dwell_s = uniform(rng, 0.2, 0.6);
  gate.pi_ambiguity = happens(0.2, rng);
  return gate;
}

/// From 0 while it stands to 1.
double share_of_speed(double since_stop_s, double stop_s) {
  constexpr double kRamp = 0.5;
  if (since_stop_s < 0.0) return std::min(1.0, -since_stop_s / kRamp);
  return std::clamp((since_stop_s - stop_s) / kRamp, 0.0, 1.0);
}

/// As round the corner of an aisle: by 45 to 110° within a fraction of a second to two seconds.
struct SharpTurn {
  double at_s = 1e9;
  double lasts_s = 1.0;
  double rad = 0.0;
};

SharpTurn any_corner(double half_s, Rng& rng) {
  const double side = happens(0.5, rng) ? 1.0 : -1.0;
  return {uniform(rng, -0.3, 0.3) * half_s, uniform(rng, 0.3, 2.0),
          side * uniform(rng, 0.25 * kPi, 0.6 * kPi)};
}

/// Positions of a tag every 5 ms, from −half to half [s]; it is where a straight motion would be at
/// the start.
Motion any_motion(Moves moves, const Eigen::Vector3d& middle, Eigen::Vector3d v, double half_s,
                  double noise, Rng& rng) {
  constexpr double kStep = 0.005;
  const double faster = moves == Moves::kFaster ? uniform(rng, -0.6, 0.6) / half_s : 0.0;
  const double turn = moves == Moves::kTurns ? uniform(rng, -0.9, 0.9) / half_s : 0.0;
  const SharpTurn corner = moves == Moves::kTurnsSharply ? any_corner(half_s, rng) : SharpTurn{};
  const double stop_at = moves == Moves::kStops ? uniform(rng, -0.25, 0.25) * half_s : 1e9;
  const double stop_s = uniform(rng, 0.3, 4.0);
  std::vector<Eigen::Vector3d> places{middle - half_s * v};
  for (double t = -half_s; t < half_s; t += kStep) {
    places.push_back(places.back() + kStep * share_of_speed(t - stop_at, stop_s) * v);
    if (moves == Moves::kByTheModel) {
      v.x() += normal(rng, noise * std::sqrt(kStep));
      v.y() += normal(rng, noise * std::sqrt(kStep));
    }
    if (std::abs(t) < 0.5 * half_s) v *= 1.0 + faster * kStep;
    if (std::abs(t) < half_s / 3.0) {
      v = Eigen::AngleAxisd(turn * kStep, Eigen::Vector3d::UnitZ()) * v;
    }
    if (t >= corner.at_s && t < corner.at_s + corner.lasts_s) {
      const double by = corner.rad / corner.lasts_s * kStep;
      v = Eigen::AngleAxisd(by, Eigen::Vector3d::UnitZ()) * v;
    }
  }
  return [places, half_s](double t) -> Eigen::Vector3d {
    const double last = static_cast<double>(places.size()) - 1.001;
    const double place = std::clamp((t + half_s) / kStep, 0.0, last);
    const auto i = static_cast<std::size_t>(place);
    const double part = place - static_cast<double>(i);
    return (1.0 - part) * places[i] + part * places[i + 1];
  };
}

/// Adds the path by a floor at z = 0 with an amplitude gain of −`gain`, both ways.
void reflect(const Gate& gate, const Motion& motion, double gain, std::vector<TagRead>& reads) {
  for (TagRead& read : reads) {
    const std::size_t antenna = static_cast<std::size_t>(read.antenna.back() - '1');
    const Eigen::Vector3d p = motion(seconds_of(read.stamp));
    const double direct = (p - gate.antennas[antenna]).norm();
    const double by_floor = (Eigen::Vector3d(p.x(), p.y(), -p.z()) - gate.antennas[antenna]).norm();
    const double k = kTwoPi / wavelength(read.frequency_hz);
    const std::complex<double> sum =
        1.0 - gain * direct / by_floor * std::polar(1.0, -k * (by_floor - direct));
    read.phase_rad = wrap_to_two_pi(read.phase_rad - 2.0 * std::arg(sum));
  }
}

struct Passage {
  std::vector<TagRead> reads;
  Motion truth;
  LocalizationProblem problem;
  TrackingOptions options;
};

Eigen::Vector3d any_place(const Gate& gate, bool height_unknown, double beside_m, Rng& rng) {
  double z = uniform(rng, 0.3, 1.3);
  if (height_unknown) {
    z = normal(rng, TrackingOptions{}.unknown_height_sigma_m);
    for (const Eigen::Vector3d& p : gate.antennas) {
      z += p.z() / static_cast<double>(gate.antennas.size());
    }
  }
  return {0.0, beside_m, z};
}

/// A lane is only stated where the tag keeps to it.
Passage any_passage(Moves moves, Disturbance disturbance, Rng& rng) {
  const Gate gate = any_gate(rng);
  Passage passage;
  Lane lane;
  lane.lateral_sigma_m = uniform(rng, 0.03, 0.3);
  double beside = uniform(rng, -0.5, 0.5);
  double heading = uniform(rng, -0.3, 0.3);
  if (moves != Moves::kTurns && moves != Moves::kTurnsSharply && happens(0.67, rng)) {
    passage.options.lane = lane;
    beside = normal(rng, lane.lateral_sigma_m);
    heading = normal(rng, lane.heading_sigma_rad);
  }
  if (moves == Moves::kByTheModel) passage.options.acceleration_noise = uniform(rng, 0.005, 0.05);
  const bool height_unknown = disturbance == Disturbance::kUnknownHeight;
  const Eigen::Vector3d middle = any_place(gate, height_unknown, beside, rng);
  const double speed = uniform(rng, 0.3, 2.0);
  const double half = (gate.range_m + 2.0) / speed;
  const Eigen::Vector3d v(speed * std::cos(heading), speed * std::sin(heading), 0.0);
  passage.truth = any_motion(moves, middle, v, half, passage.options.acceleration_noise, rng);
  read_motion(gate, "tag", passage.truth, -half, half, rng, passage.reads);
  if (disturbance == Disturbance::kFloor) {
    reflect(gate, passage.truth, uniform(rng, 0.1, 0.5), passage.reads);
  }
  if (disturbance == Disturbance::kStrays) {
    const double share = uniform(rng, 0.01, 0.06);
    for (TagRead& read : passage.reads) {
      if (happens(share, rng)) read.phase_rad = uniform(rng, 0.0, kTwoPi);
    }
  }
  passage.problem = problem_of(gate, passage.reads, middle.z());
  if (height_unknown) passage.problem.heights.of_all.reset();
  return passage;
}

struct TrackClaims {
  int passes = 0;
  int tracked = 0;
  int false_ones = 0;
  int ambiguous = 0;
  int without_truth = 0;  ///< Of the ambiguous.
};

/// Whether a track is anywhere over 3 cm and six standard deviations off, seen from above.
bool is_false(const Track& track, const Motion& truth) {
  return std::any_of(track.points.begin(), track.points.end(), [&](const TrackPoint& point) {
    const Eigen::Vector2d error = (point.p_WT - truth(seconds_of(point.stamp))).head<2>();
    const Eigen::Matrix2d covariance = point.covariance.topLeftCorner<2, 2>();
    return error.norm() > 0.03 && error.dot(covariance.inverse() * error) > 36.0;
  });
}

void add(const Passage& passage, const std::string& what, TrackClaims& claims) {
  Diagnostics diagnostics;
  const std::vector<TagTrack> tracks = track_tags(passage.problem, passage.options, 1, diagnostics);
  ++claims.passes;
  if (tracks.empty() || tracks.front().verdict == TrackVerdict::kNotTracked) return;
  const std::vector<Track>& of_tag = tracks.front().tracks;
  const auto wrong = [&](const Track& track) { return is_false(track, passage.truth); };
  if (tracks.front().verdict == TrackVerdict::kTracked) {
    ++claims.tracked;
    if (!wrong(of_tag.front())) return;
    ++claims.false_ones;
    fmt::print("{}: {} reads, expected error {:.3f} m\n", what, passage.reads.size(),
               of_tag.front().expected_error_m);
  } else {
    ++claims.ambiguous;
    if (std::all_of(of_tag.begin(), of_tag.end(), wrong)) ++claims.without_truth;
  }
}

int count_of_passes() {
  constexpr int kUsual = 24;
  const char* const asked = std::getenv("TAGFIELD_PASSES");
  return asked == nullptr ? kUsual : std::max(1, std::atoi(asked));
}

void print(const std::string& name, const TrackClaims& claims) {
  fmt::print("{}: of {} passes {} tracked, {} of these false; {} ambiguous, {} without the truth\n",
             name, claims.passes, claims.tracked, claims.false_ones, claims.ambiguous,
             claims.without_truth);
}

TrackClaims random_claims(const std::string& name, TrackMethod method,
                          const std::vector<Disturbance>& disturbances, int count) {
  TrackClaims claims;
  for (int seed = 1; seed <= count; ++seed) {
    Rng rng(static_cast<unsigned>(seed));
    const auto moves = static_cast<Moves>(any_of(5, rng));
    const Disturbance disturbance =
        disturbances[static_cast<std::size_t>(any_of(static_cast<int>(disturbances.size()), rng))];
    Passage passage = any_passage(moves, disturbance, rng);
    passage.options.method = method;
    const std::string what = fmt::format("seed {}, motion {}, disturbance {}", seed,
                                         static_cast<int>(moves), static_cast<int>(disturbance));
    add(passage, what, claims);
  }
  print(name, claims);
  return claims;
}

TEST(RandomPasses, AreRarelyTrackedWrongly) {
  const TrackClaims claims = random_claims(
      "ekf", TrackMethod::kEkf,
      {Disturbance::kNone, Disturbance::kStrays, Disturbance::kUnknownHeight}, count_of_passes());
  EXPECT_GT(claims.tracked, claims.passes / 8);
  EXPECT_LE(claims.false_ones, 1 + claims.tracked / 20);
}

TEST(RandomPasses, BesideAReflectingFloorAreRarelyTrackedWrongly) {
  const TrackClaims claims =
      random_claims("ekf, floor", TrackMethod::kEkf, {Disturbance::kFloor}, count_of_passes() / 2);
  EXPECT_GT(claims.tracked, claims.passes / 8);
  EXPECT_LE(claims.false_ones, 2 + claims.tracked / 6);
}

Passage without_lane(Moves moves, int seed) {
  Rng rng(static_cast<unsigned>(seed));
  Passage passage = any_passage(moves, Disturbance::kNone, rng);
  passage.options.lane.reset();
  return passage;
}

TEST(RandomPasses, CornersAndStopsWithoutALaneAreRarelyTrackedWrongly) {
  for (const Moves moves : {Moves::kStops, Moves::kTurnsSharply}) {
    const std::string name = moves == Moves::kStops ? "stops" : "corners";
    TrackClaims claims;
    for (int seed = 1; seed <= count_of_passes() / 6; ++seed) {
      add(without_lane(moves, seed), fmt::format("{}, seed {}", name, seed), claims);
    }
    print(name, claims);
    EXPECT_LE(claims.false_ones, 1 + claims.tracked / 8);
  }
}

/// From the start of the pass alone, whole turns of the phases are decided wrongly where these
/// stop: one track is 2 m off and claims 2 cm, the other 0.9 m off.
TEST(RandomPasses, StopsAreSmoothedFromBothEndsOfThePass) {
  for (const int seed : {7, 36}) {
    TrackClaims claims;
    add(without_lane(Moves::kStops, seed), fmt::format("seed {}", seed), claims);
    EXPECT_EQ(claims.false_ones, 0) << seed;
  }
}

TEST(RandomPasses, OtherMethodsAreRarelyWrongEither) {
  for (const TrackMethod method : {TrackMethod::kUkf, TrackMethod::kParticle}) {
    const TrackClaims claims =
        random_claims(to_string(method), method, {Disturbance::kNone}, count_of_passes() / 12);
    EXPECT_LE(claims.false_ones, 1 + claims.tracked / 10);
  }
}

}  // namespace
}  // namespace tagfield::made
