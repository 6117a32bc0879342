// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/moving_obstacles.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kMaxGap = 0.25;    // Between neighbours of a group [m].
constexpr double kMaxAcross = 1.2;  // [m]
constexpr std::size_t kMinReturns = 3;
constexpr double kMaxRange = 10.0;  // Farther away there are too few beams on a person [m].
constexpr double kMinRadius = 0.05;
constexpr double kMaxRadius = 0.6;

constexpr double kSigmaWhole = 0.04;  // Of a group's centre [m].
constexpr double kSigmaCut = 0.15;    // Where only part of it can be seen [m],
constexpr double kSigmaRound = 0.06;  // and that is curved [m].
/// The curvature of the visible part is evaluated from this half length on [m]. The part counts as
/// curved from this fraction of the expected curvature on, and this multiple of the noise of a
/// mean.
constexpr double kMinHalfChord = 0.08;
constexpr double kRoundFrom = 0.5;
constexpr double kSurely = 3.5;
constexpr double kRangeSigma = 0.01;        // [m]
constexpr double kSigmaAcceleration = 1.5;  // Of people walking [m/s²].
constexpr double kSigmaFirstVelocity = 1.0;
constexpr double kGate = 0.4;        // Between a track and its group [m],
constexpr double kGateGrowth = 0.4;  // growing with the time since it was seen [m/s].
constexpr double kMaxGate = 1.0;
constexpr double kMovesFrom = 0.2;    // [m/s]
constexpr double kStandsBelow = 0.1;  // [m/s]
constexpr int kUpdatesToMove = 6;
constexpr int kMissesToForget = 5;
constexpr double kUnsureKept = 0.3;   // How long an unseen track that does not move is kept [s].
constexpr double kRadiusShare = 0.1;  // Weight of a new measurement in a track's radius.

/// Whether the beam next to the group is blocked by something nearer, or outside the field of view.
bool is_cut_at(const ScanInMap& scan, std::ptrdiff_t beside, double range_m) {
  if (beside < 0 || beside >= static_cast<std::ptrdiff_t>(scan.clear_m.size())) return true;
  return scan.clear_m[static_cast<std::size_t>(beside)] < range_m - kMaxGap;
}

/// Mean range of the middle third of a group's returns: for a disc, almost that of its nearest
/// point.
double middle_range(const ScanInMap& scan, const std::vector<std::size_t>& returns) {
  const std::size_t third = returns.size() / 3;
  double sum = 0.0;
  for (std::size_t i = third; i < returns.size() - third; ++i) {
    sum += scan.returns[returns[i]].range_m;
  }
  return sum / static_cast<double>(returns.size() - 2 * third);
}

/// Mean position of the returns in [begin, end).
Eigen::Vector2d mean_point(const ScanInMap& scan, const std::vector<std::size_t>& returns,
                           std::size_t begin, std::size_t end) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (std::size_t i = begin; i < end; ++i) sum += scan.returns[returns[i]].point_M;
  return sum / static_cast<double>(end - begin);
}

/// Takes the visible part of a disc for part of a person of the usual size if its curvature
/// matches: a flat side of some other object that gradually comes into view would seem to walk. The
/// means of its first, middle and last third give the curvature.
void fit_part(const ScanInMap& scan, ReturnGroup& group) {
  const std::size_t third = group.returns.size() / 3;
  const Eigen::Vector2d first = mean_point(scan, group.returns, 0, third);
  const Eigen::Vector2d middle =
      mean_point(scan, group.returns, third, group.returns.size() - third);
  const Eigen::Vector2d last =
      mean_point(scan, group.returns, group.returns.size() - third, group.returns.size());
  const double half_chord = 0.5 * (last - first).norm();
  if (half_chord < kMinHalfChord || half_chord > kUsualRadius_m) return;
  // Beams run counterclockwise, so away from the laser is to the right of the line from first to
  // last.
  const Eigen::Vector2d along = (last - first) / (2.0 * half_chord);
  const Eigen::Vector2d away(along.y(), -along.x());
  const double depth = std::sqrt(kUsualRadius_m * kUsualRadius_m - half_chord * half_chord);
  const Eigen::Vector2d chord_middle = 0.5 * (first + last);
  const double bulge = (chord_middle - middle).dot(away);
  const double noise = kRangeSigma / std::sqrt(static_cast<double>(third));
  if (bulge < std::max(kRoundFrom * (kUsualRadius_m - depth), kSurely * noise)) return;
  group.is_round = true;
  group.radius_m = kUsualRadius_m;
  group.centre_M = chord_middle + depth * away;
}

void fit_disc(const ScanInMap& scan, ReturnGroup& group) {
  const ScanReturn& first = scan.returns[group.returns.front()];
  const ScanReturn& last = scan.returns[group.returns.back()];
  const double step = scan.angle_step_rad;
  const double half_angle = 0.5 * step * static_cast<double>(last.beam - first.beam + 1);
  const double near = middle_range(scan, group.returns);
  const double of_half = sine(std::min(half_angle, 1.0));
  group.radius_m = std::clamp(near * of_half / (1.0 - of_half), kMinRadius, kMaxRadius);
  const double angle = scan.q_ML.yaw + scan.first_angle_rad +
                       0.5 * step * static_cast<double>(first.beam + last.beam);
  group.centre_M = position_of(scan.q_ML) +
                   (near + group.radius_m) * Eigen::Vector2d(cosine(angle), sine(angle));
  group.is_cut = is_cut_at(scan, static_cast<std::ptrdiff_t>(first.beam) - 1, first.range_m) ||
                 is_cut_at(scan, static_cast<std::ptrdiff_t>(last.beam) + 1, last.range_m);
  if (group.is_cut) fit_part(scan, group);
}

double sigma_of(const ReturnGroup& group) {
  if (!group.is_cut) return kSigmaWhole;
  return group.is_round ? kSigmaRound : kSigmaCut;
}

bool is_group(const ScanInMap& scan, const std::vector<std::size_t>& returns) {
  return returns.size() >= kMinReturns &&
         (scan.returns[returns.front()].point_M - scan.returns[returns.back()].point_M).norm() <=
             kMaxAcross;
}

}  // namespace

std::vector<ReturnGroup> groups_of(const ScanInMap& scan, const std::vector<bool>& is_candidate) {
  std::vector<ReturnGroup> groups;
  std::vector<std::size_t> open;
  const auto close = [&] {
    if (is_group(scan, open)) {
      ReturnGroup group;
      group.returns = open;
      fit_disc(scan, group);
      groups.push_back(std::move(group));
    }
    open.clear();
  };
  for (std::size_t i = 0; i < scan.returns.size(); ++i) {
    if (!is_candidate[i] || scan.returns[i].range_m > kMaxRange) continue;
    if (!open.empty() &&
        (scan.returns[i].point_M - scan.returns[open.back()].point_M).norm() > kMaxGap) {
      close();
    }
    open.push_back(i);
  }
  close();
  return groups;
}

void ObstacleTracker::Track::predict(Time to) {
  const double t = to_seconds(to - time);
  if (t <= 0.0) return;
  const double q = kSigmaAcceleration * kSigmaAcceleration;
  centre_M += t * velocity_M;
  var_place += t * (2.0 * covar + t * var_velocity) + 0.25 * q * t * t * t * t;
  covar += t * var_velocity + 0.5 * q * t * t * t;
  var_velocity += q * t * t;
  time = to;
}

void ObstacleTracker::Track::correct(const ReturnGroup& group) {
  const double sigma = sigma_of(group);
  const bool is_known = !group.is_cut || group.is_round;
  const double innovation_var = var_place + sigma * sigma;
  const double gain_place = var_place / innovation_var;
  // When a person goes out of sight, the centre of the part still visible moves differently from
  // the person.
  const double gain_velocity = is_known ? covar / innovation_var : 0.0;
  const Eigen::Vector2d innovation = group.centre_M - centre_M;
  centre_M += gain_place * innovation;
  velocity_M += gain_velocity * innovation;
  var_velocity -= gain_velocity * covar;
  covar -= is_known ? gain_velocity * var_place : gain_place * covar;
  var_place -= gain_place * var_place;
  if (!group.is_cut) radius_m += kRadiusShare * (group.radius_m - radius_m);
  ++updates;
  misses = 0;
  seen = time;
  const double speed = velocity_M.norm();
  const bool is_sure = speed > 2.0 * std::sqrt(var_velocity) && updates >= kUpdatesToMove;
  is_moving = is_moving ? speed > kStandsBelow : is_sure && speed > kMovesFrom;
}

ObstacleTracker::Track ObstacleTracker::begin(const ReturnGroup& group, Time now) {
  Track track;
  track.centre_M = group.centre_M;
  const double sigma = sigma_of(group);
  track.var_place = sigma * sigma;
  track.var_velocity = kSigmaFirstVelocity * kSigmaFirstVelocity;
  track.radius_m = group.radius_m;
  track.time = now;
  track.seen = now;
  track.updates = 1;
  return track;
}

std::vector<int> ObstacleTracker::assign(const std::vector<ReturnGroup>& groups) const {
  std::vector<std::tuple<double, std::size_t, std::size_t>> pairs;
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    const double unseen_s = to_seconds(tracks_[t].time - tracks_[t].seen);
    const double gate = std::min(kGate + kGateGrowth * unseen_s, kMaxGate);
    for (std::size_t g = 0; g < groups.size(); ++g) {
      const double distance = (groups[g].centre_M - tracks_[t].centre_M).norm();
      if (distance < gate) pairs.emplace_back(distance, t, g);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  std::vector<int> group_of(tracks_.size(), -1);
  std::vector<bool> is_taken(groups.size());
  for (const auto& [distance, t, g] : pairs) {
    if (group_of[t] >= 0 || is_taken[g]) continue;
    group_of[t] = static_cast<int>(g);
    is_taken[g] = true;
  }
  return group_of;
}

/// Counts the scans that see through the positions of unseen tracks, and drops tracks that are
/// gone.
void ObstacleTracker::forget(const ScanInMap& scan) {
  for (Track& track : tracks_) {
    if (track.seen == scan.stamp) continue;
    const double range = (track.centre_M - position_of(scan.q_ML)).norm();
    if (scan.clear_towards(track.centre_M, 0.009) > range + track.radius_m) ++track.misses;
  }
  std::erase_if(tracks_, [&](const Track& track) {
    const double unseen_s = to_seconds(scan.stamp - track.seen);
    return track.misses >= kMissesToForget ||
           unseen_s > (track.is_moving ? kKeptUnseen : kUnsureKept);
  });
}

std::vector<bool> ObstacleTracker::update(const ScanInMap& scan,
                                          const std::vector<bool>& is_candidate) {
  const std::vector<ReturnGroup> groups = groups_of(scan, is_candidate);
  for (Track& track : tracks_) track.predict(scan.stamp);
  const std::vector<int> group_of = assign(groups);
  std::vector<bool> is_taken(groups.size());
  std::vector<bool> belongs(scan.returns.size());
  for (std::size_t t = 0; t < tracks_.size(); ++t) {
    if (group_of[t] < 0) continue;
    const auto g = static_cast<std::size_t>(group_of[t]);
    is_taken[g] = true;
    tracks_[t].correct(groups[g]);
    if (!tracks_[t].is_moving) continue;
    for (const std::size_t i : groups[g].returns) belongs[i] = true;
  }
  forget(scan);
  for (std::size_t g = 0; g < groups.size(); ++g) {
    if (!is_taken[g]) tracks_.push_back(begin(groups[g], scan.stamp));
  }
  return belongs;
}

std::vector<MovingObstacle> ObstacleTracker::moving(Time now) const {
  std::vector<MovingObstacle> found;
  for (const Track& track : tracks_) {
    if (!track.is_moving) continue;
    const MovingObstacle then{track.centre_M, track.velocity_M, track.radius_m};
    found.push_back({then.at(to_seconds(now - track.time)), track.velocity_M, track.radius_m});
  }
  return found;
}

}  // namespace tagfield
