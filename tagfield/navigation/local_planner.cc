// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/local_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kScoredAfter = 1.0;  // When a manoeuvre is compared with the wanted one [s].
constexpr double kHold = 1.0;         // How long a nominal manoeuvre holds its velocity [s],
constexpr double kLongHold = 2.5;     // and how long if there are moving obstacles.
constexpr double kFirstHold = 0.6;    // Of an evasive manoeuvre's two velocities [s].
constexpr double kSecondHold = 1.5;

/// How much nearer than the margin the nearest of many noisy returns may seem [m].
constexpr double kNoise = 0.025;
/// Kept in addition to the radius by a robot that is already nearer than its margin [m].
constexpr double kBareMargin = 0.01;
constexpr double kHardlyTurned = 0.03;  // [rad]
/// By how much more than the margin the gap must have grown before an evasive manoeuvre is aborted
/// [m],
constexpr double kSurelyOver = 0.1;
/// and by how much less it may appear while the manoeuvre continues.
constexpr double kGoesOn = 0.03;
/// A larger gap than this to a moving obstacle gains nothing [m].
constexpr double kWantedGap = 0.4;

// Weights of the costs: each cost is about 1 where it becomes bad.
constexpr double kPerMetre = 1.0 / 0.3;
constexpr double kPerRadian = 0.4;
constexpr double kForClearance = 0.3;
constexpr double kForGap = 1.0;
constexpr double kForChange = 0.05;

double square(double x) { return x * x; }

struct Candidate {
  Manoeuvre manoeuvre;
  /// How far it is from being allowed, roughly in metres; 0 if it is allowed.
  double badness = std::numeric_limits<double>::infinity();
  double cost = std::numeric_limits<double>::infinity();
};

/// Judges manoeuvres and keeps the best.
class Chooser {
 public:
  /// `gap_m` is the gap to keep from moving obstacles.
  Chooser(const Rollouts& rollouts, const BodyVelocity& wanted, const Surroundings& around,
          double gap_m, const LocalSettings& settings)
      : rollouts_(rollouts),
        reference_(rollouts.after({wanted, kScoredAfter, {}, 0.0}, kScoredAfter)),
        clear_now_m_(rollouts.outcome({}).clear_m),
        is_too_near_(around.clear_now_m < settings.size.radius_m),
        gap_m_(gap_m),
        size_(settings.size) {}

  void consider(const Manoeuvre& manoeuvre, double extra_cost);
  [[nodiscard]] const Candidate& best() const { return best_; }

 private:
  [[nodiscard]] double badness(const Outcome& result) const;
  [[nodiscard]] double cost(const Manoeuvre& manoeuvre, const Outcome& result) const;

  const Rollouts& rollouts_;
  PlanarPose reference_;  ///< Where the wanted velocity would lead in kScoredAfter.
  double clear_now_m_;
  bool is_too_near_;  ///< To turn on the spot: a corner might collide.
  double gap_m_;
  RobotRoom size_;
  Candidate best_;
};

double Chooser::badness(const Outcome& result) const {
  const double bare = size_.radius_m + kBareMargin;
  double needed = std::max(bare, size_.min_m() - kNoise);
  double bad = result.backs_blindly ? 1.0 : 0.0;
  // A robot nearer than the margin may go on, but hardly any nearer.
  if (clear_now_m_ < needed) needed = std::max(bare, clear_now_m_ - kBareMargin);
  if (clear_now_m_ < bare) needed = clear_now_m_ - 0.5 * kBareMargin;
  if (is_too_near_) {
    const bool gets_away = result.end_clear_m > clear_now_m_ + kBareMargin;
    const bool stays = result.moved_m < kBareMargin && result.turned_rad < kHardlyTurned;
    if (!gets_away && !stays) bad += 0.1;
  }
  return bad + std::max(0.0, needed - result.clear_m) + std::max(0.0, gap_m_ - result.gap_m);
}

double Chooser::cost(const Manoeuvre& manoeuvre, const Outcome& result) const {
  const PlanarPose then = rollouts_.after(manoeuvre, kScoredAfter);
  const double off_m = (position_of(then) - position_of(reference_)).norm();
  const double clearance = std::max(size_.clearance_m, 1e-3);
  const double lack = std::max(0.0, 1.0 - (result.clear_m - size_.min_m()) / clearance);
  const double gap_lack = std::max(0.0, 1.0 - result.gap_m / kWantedGap);
  return kPerMetre * off_m + kPerRadian * std::abs(then.yaw - reference_.yaw) +
         kForClearance * square(lack) + kForGap * square(gap_lack);
}

void Chooser::consider(const Manoeuvre& manoeuvre, double extra_cost) {
  const Outcome result = rollouts_.outcome(manoeuvre);
  Candidate candidate{manoeuvre, badness(result), 0.0};
  if (candidate.badness > best_.badness) return;
  candidate.cost = cost(manoeuvre, result) + extra_cost;
  if (candidate.badness < best_.badness || candidate.cost < best_.cost) best_ = candidate;
}

/// Considers velocities slower than wanted, and turning a little more or less.
void consider_nominal(Chooser& chooser, const BodyVelocity& wanted, const BodyVelocity& last,
                      const LocalSettings& settings, double hold_s) {
  constexpr std::array<double, 5> kShares = {1.0, 0.75, 0.5, 0.25, 0.0};
  constexpr std::array<double, 9> kTurns = {0.0, 0.15, -0.15, 0.35, -0.35, 0.7, -0.7, 1.2, -1.2};
  const double most = settings.limits.turn_rad_s;
  for (const double share : kShares) {
    for (const double more : kTurns) {
      const BodyVelocity first{share * wanted.forward, std::clamp(wanted.turn + more, -most, most)};
      chooser.consider({first, hold_s, {}, 0.0}, kForChange * std::abs(first.turn - last.turn));
    }
  }
  chooser.consider({}, kForChange * std::abs(last.turn));
}

/// Considers ways out of a position too near to an obstacle for turning: slowly, in wide arcs, as
/// the footprint's corners swing out on the other side.
void consider_ways_out(Chooser& chooser, const LocalSettings& settings) {
  const double speed = std::min(0.2, settings.limits.speed_m_s);
  for (const double forward : {speed, -speed}) {
    for (const double turn : {0.0, 0.15, -0.15, 0.3, -0.3}) {
      chooser.consider({{forward, turn}, kHold, {}, 0.0}, 0.0);
    }
  }
  constexpr double kOnlyIfNothingElse = 100.0;
  chooser.consider({}, kOnlyIfNothingElse);
}

/// Considers moving away from an approaching person as fast as the drive can.
void consider_evasions(Chooser& chooser, const LocalSettings& settings) {
  constexpr std::array<double, 5> kForward = {0.0, 1.0, 0.5, -0.4, -1.0};
  constexpr std::array<double, 5> kTurn = {0.0, 0.5, -0.5, 1.0, -1.0};
  constexpr std::array<std::array<double, 2>, 8> kSecond = {{{0.0, 0.0},
                                                             {1.0, 0.0},
                                                             {0.5, 0.0},
                                                             {0.8, 0.7},
                                                             {0.8, -0.7},
                                                             {-1.0, 0.0},
                                                             {0.0, 1.0},
                                                             {0.0, -1.0}}};
  const SpeedLimits& limits = settings.limits;
  for (const double forward : kForward) {
    for (const double turn : kTurn) {
      const BodyVelocity first{forward * limits.speed_m_s, turn * limits.turn_rad_s};
      chooser.consider({first, kFirstHold + kSecondHold, {}, 0.0}, 0.0);
      for (const auto& [then, turning] : kSecond) {
        const BodyVelocity second{then * limits.speed_m_s, turning * limits.turn_rad_s};
        chooser.consider({first, kFirstHold, second, kSecondHold}, 0.0);
      }
    }
  }
}

/// The rest of the evasive manoeuvre `begun` as long as it is allowed, or else the best of all:
/// going to and fro would not get the robot out of the way.
Manoeuvre evasion(Chooser going_on, Chooser anew, const Manoeuvre* begun,
                  const LocalSettings& settings) {
  if (begun != nullptr) going_on.consider(rest_of(*begun, settings.period_s), 0.0);
  if (going_on.best().badness == 0.0) return going_on.best().manoeuvre;
  consider_evasions(anew, settings);
  return anew.best().manoeuvre;
}

bool is_same(const BodyVelocity& a, const BodyVelocity& b) {
  return std::abs(a.forward - b.forward) < 1e-9 && std::abs(a.turn - b.turn) < 1e-9;
}

/// The best manoeuvre near to the wanted velocity, subject to a gap of `gap_m` to moving obstacles.
Candidate best_nominal(Chooser chooser, const BodyVelocity& wanted, const BodyVelocity& last,
                       const Surroundings& around, const LocalSettings& settings) {
  if (around.clear_now_m < settings.size.radius_m) {
    consider_ways_out(chooser, settings);
    return chooser.best();
  }
  consider_nominal(chooser, wanted, last, settings, kHold);
  if (!around.moving.empty()) consider_nominal(chooser, wanted, last, settings, kLongHold);
  return chooser.best();
}

}  // namespace

double window_half(const LocalSettings& settings) {
  return (kFirstHold + kSecondHold) * settings.limits.speed_m_s + settings.size.min_m() +
         settings.size.clearance_m;
}

Decision decide(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
                const Surroundings& around, const std::optional<Decision>& last,
                const LocalSettings& settings) {
  const Rollouts rollouts(pose_M, present, around, settings);
  const double margin = settings.size.margin_m;
  const bool was_evading = last && last->is_evading;
  const auto chooser_for = [&](double gap_m) {
    return Chooser(rollouts, wanted, around, gap_m, settings);
  };
  const Candidate nominal =
      best_nominal(chooser_for(margin + (was_evading ? kSurelyOver : 0.0)), wanted,
                   last ? last->manoeuvre.first : present, around, settings);
  Decision decision;
  // If static obstacles rule out every manoeuvre, none is driven: the robot brakes.
  if (nominal.badness == 0.0) decision.manoeuvre = nominal.manoeuvre;
  decision.is_evading = nominal.badness > 0.0 && !around.moving.empty();
  if (decision.is_evading) {
    decision.manoeuvre = evasion(chooser_for(margin - kGoesOn), chooser_for(margin),
                                 was_evading ? &last->manoeuvre : nullptr, settings);
  }
  decision.command =
      limited(target_at(decision.manoeuvre, 0.0), present, settings.limits, settings.period_s);
  if (!is_same(decision.manoeuvre.first, wanted)) {
    const bool is_near = rollouts.outcome({wanted, kHold, {}, 0.0}).gap_m < kWantedGap;
    decision.hindrance = is_near ? Hindrance::kMoving : Hindrance::kStanding;
  }
  return decision;
}

}  // namespace tagfield
