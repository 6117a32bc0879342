#include "navigation/local_planner.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

constexpr double kStep = 0.1;         // Of a rollout [s].
constexpr double kScoredAfter = 1.0;  // When a manoeuvre is compared with what was wanted [s].
constexpr double kHold = 1.0;         // How long a nominal manoeuvre holds its velocity [s],
constexpr double kLongHold = 2.5;     // and how long where somebody moves.
constexpr double kFirstHold = 0.6;    // Of an evasion's two velocities [s].
constexpr double kSecondHold = 1.5;

/// How much nearer than the margin the nearest of many noisy returns may seem [m].
constexpr double kNoise = 0.025;
/// Kept beside the radius by a robot that stands nearer than its margin already [m].
constexpr double kBareMargin = 0.01;
/// How fast it grows unsure where one who moves will be [m/s].
constexpr double kUnsure = 0.1;
/// Beyond this gap to one who moves nothing is gained [m].
constexpr double kWantedGap = 0.4;

// Weights of the costs: each is about 1 where it would be bad.
constexpr double kPerMetre = 1.0 / 0.3;
constexpr double kPerRadian = 0.4;
constexpr double kForClearance = 0.3;
constexpr double kForGap = 1.0;
constexpr double kForChange = 0.05;

/// What comes of a manoeuvre.
struct Outcome {
  double clear_m = std::numeric_limits<double>::infinity();  ///< Least distance to what stands.
  double end_clear_m = 0.0;
  double gap_m = std::numeric_limits<double>::infinity();  ///< Least gap to those who move.
  bool is_on_known_ground = true;
  PlanarPose scored;  ///< The pose after kScoredAfter.
  double moved_m = 0.0;
};

struct Candidate {
  Manoeuvre manoeuvre;
  double cost = std::numeric_limits<double>::infinity();
  double badness = std::numeric_limits<double>::infinity();
};

BodyVelocity target_at(const Manoeuvre& manoeuvre, double t) {
  if (t < manoeuvre.first_s - 1e-9) return manoeuvre.first;
  if (t < manoeuvre.first_s + manoeuvre.second_s - 1e-9) return manoeuvre.second;
  return {};
}

/// One decision's view of all manoeuvres.
class Chooser {
 public:
  Chooser(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
          const Surroundings& around, const LocalSettings& settings)
      : pose_M_(pose_M),
        present_(present),
        around_(around),
        settings_(settings),
        clear_now_(around.standing->at(position_of(pose_M))) {
    reference_ = outcome({wanted, kScoredAfter, {}, 0.0}, false).scored;
  }

  void consider(const Manoeuvre& manoeuvre, double extra_cost);
  [[nodiscard]] const Candidate& best() const { return best_; }
  [[nodiscard]] Outcome outcome(const Manoeuvre& manoeuvre, bool is_checked) const;

 private:
  void check(const PlanarPose& pose, const BodyVelocity& velocity, double t, Outcome& result) const;
  [[nodiscard]] bool backs_on_known_ground(const PlanarPose& pose) const;
  [[nodiscard]] double badness(const Outcome& result) const;
  [[nodiscard]] double cost(const Outcome& result) const;

  const PlanarPose& pose_M_;
  const BodyVelocity& present_;
  const Surroundings& around_;
  const LocalSettings& settings_;
  double clear_now_;
  PlanarPose reference_;  ///< Where what is wanted would lead in kScoredAfter.
  Candidate best_;
};

/// The half of the outline's circle that comes first when backing.
bool Chooser::backs_on_known_ground(const PlanarPose& pose) const {
  constexpr int kPoints = 7;
  for (int i = 0; i < kPoints; ++i) {
    const double angle = pose.yaw + kPi / 2.0 + kPi * i / (kPoints - 1);
    const Eigen::Vector2d rim =
        position_of(pose) +
        settings_.size.radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle));
    if (!around_.is_known_free(rim)) return false;
  }
  return true;
}

void Chooser::check(const PlanarPose& pose, const BodyVelocity& velocity, double t,
                    Outcome& result) const {
  const Eigen::Vector2d place = position_of(pose);
  if (velocity.forward != 0.0) {
    result.end_clear_m = around_.standing->at(place);
    result.clear_m = std::min(result.clear_m, result.end_clear_m);
  }
  if (velocity.forward < 0.0 && result.is_on_known_ground) {
    result.is_on_known_ground = backs_on_known_ground(pose);
  }
  for (const MovingObstacle& moving : around_.moving) {
    const double distance = (moving.at(t) - place).norm();
    result.gap_m =
        std::min(result.gap_m, distance - moving.radius_m - settings_.size.radius_m - kUnsure * t);
  }
}

Outcome Chooser::outcome(const Manoeuvre& manoeuvre, bool is_checked) const {
  Outcome result;
  result.clear_m = clear_now_;
  result.end_clear_m = clear_now_;
  PlanarPose pose = pose_M_;
  BodyVelocity velocity = present_;
  const int steps = static_cast<int>(std::lround((is_checked ? kHorizon : kScoredAfter) / kStep));
  for (int i = 0; i < steps; ++i) {
    const BodyVelocity next =
        limited(target_at(manoeuvre, i * kStep), velocity, settings_.limits, kStep);
    const BodyVelocity mean{0.5 * (velocity.forward + next.forward),
                            0.5 * (velocity.turn + next.turn)};
    if (mean.forward != 0.0 || mean.turn != 0.0) pose = advance(pose, mean, kStep);
    velocity = next;
    if ((i + 1) * kStep <= kScoredAfter + 1e-9) result.scored = pose;
    if (is_checked) check(pose, mean, (i + 1) * kStep, result);
  }
  result.moved_m = (position_of(pose) - position_of(pose_M_)).norm();
  return result;
}

/// How far a manoeuvre is from being allowed; 0 where it is.
double Chooser::badness(const Outcome& result) const {
  const double bare = settings_.size.radius_m + kBareMargin;
  const double least = std::max(bare, settings_.size.least_m() - kNoise);
  double needed = least;
  double bad = result.is_on_known_ground ? 0.0 : 1.0;
  if (clear_now_ < least) needed = std::max(bare, clear_now_ - kBareMargin);
  if (clear_now_ < bare) {
    // Only out of there.
    needed = clear_now_ - 0.5 * kBareMargin;
    if (result.moved_m > kBareMargin && result.end_clear_m < clear_now_ + kBareMargin) bad += 0.1;
  }
  bad += std::max(0.0, needed - result.clear_m);
  bad += std::max(0.0, settings_.size.margin_m - result.gap_m);
  return bad;
}

double Chooser::cost(const Outcome& result) const {
  const auto square = [](double x) { return x * x; };
  const double off_m = (position_of(result.scored) - position_of(reference_)).norm();
  const double off_rad = std::abs(result.scored.yaw - reference_.yaw);
  const double clearance = std::max(settings_.size.clearance_m, 1e-3);
  const double lack = std::max(0.0, 1.0 - (result.clear_m - settings_.size.least_m()) / clearance);
  const double gap_lack = std::max(0.0, 1.0 - result.gap_m / kWantedGap);
  return kPerMetre * off_m + kPerRadian * off_rad + kForClearance * square(lack) +
         kForGap * square(gap_lack);
}

void Chooser::consider(const Manoeuvre& manoeuvre, double extra_cost) {
  const Outcome result = outcome(manoeuvre, true);
  const Candidate candidate{manoeuvre, cost(result) + extra_cost, badness(result)};
  const bool is_better = candidate.badness == best_.badness ? candidate.cost < best_.cost
                                                            : candidate.badness < best_.badness;
  if (is_better) best_ = candidate;
}

/// Slower than wanted, and with a little more or less of a turn.
void consider_nominal(Chooser& chooser, const BodyVelocity& wanted, const BodyVelocity& last,
                      const LocalSettings& settings, double hold_s) {
  constexpr std::array<double, 5> kShares = {1.0, 0.75, 0.5, 0.25, 0.0};
  constexpr std::array<double, 9> kTurns = {0.0, 0.15, -0.15, 0.35, -0.35, 0.7, -0.7, 1.2, -1.2};
  for (const double share : kShares) {
    for (const double more : kTurns) {
      const double most = settings.limits.turn_rad_s;
      const BodyVelocity first{share * wanted.forward, std::clamp(wanted.turn + more, -most, most)};
      chooser.consider({first, hold_s, {}, 0.0}, kForChange * std::abs(first.turn - last.turn));
    }
  }
  chooser.consider({}, kForChange * std::abs(last.turn));
}

/// Away from who comes, as fast as the drive can.
void consider_evasions(Chooser& chooser, const LocalSettings& settings) {
  constexpr std::array<double, 5> kForward = {0.0, 1.0, 0.5, -0.3, -0.7};
  constexpr std::array<double, 5> kTurn = {0.0, 0.5, -0.5, 1.0, -1.0};
  constexpr std::array<std::array<double, 2>, 8> kSecond = {{{0.0, 0.0},
                                                             {1.0, 0.0},
                                                             {0.5, 0.0},
                                                             {0.8, 0.7},
                                                             {0.8, -0.7},
                                                             {-0.7, 0.0},
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

/// What is left of a manoeuvre after `seconds`.
Manoeuvre rest_of(const Manoeuvre& manoeuvre, double seconds) {
  Manoeuvre rest = manoeuvre;
  const double of_first = std::min(seconds, rest.first_s);
  rest.first_s -= of_first;
  rest.second_s = std::max(0.0, rest.second_s - (seconds - of_first));
  return rest;
}

bool is_same(const BodyVelocity& a, const BodyVelocity& b) {
  return std::abs(a.forward - b.forward) < 1e-9 && std::abs(a.turn - b.turn) < 1e-9;
}

}  // namespace

double window_half(const LocalSettings& settings) {
  return (kFirstHold + kSecondHold) * settings.limits.speed_m_s + settings.size.least_m() +
         settings.size.clearance_m;
}

Decision decide(const PlanarPose& pose_M, const BodyVelocity& present, const BodyVelocity& wanted,
                const Surroundings& around, const std::optional<Manoeuvre>& last,
                const LocalSettings& settings) {
  Chooser chooser(pose_M, present, wanted, around, settings);
  const BodyVelocity last_velocity = last ? last->first : present;
  consider_nominal(chooser, wanted, last_velocity, settings, kHold);
  if (!around.moving.empty()) {
    consider_nominal(chooser, wanted, last_velocity, settings, kLongHold);
    if (chooser.best().badness > 0.0 && last) {
      chooser.consider(rest_of(*last, settings.period_s), 0.0);
    }
    if (chooser.best().badness > 0.0) consider_evasions(chooser, settings);
  }
  Decision decision;
  decision.manoeuvre = chooser.best().manoeuvre;
  // What is not allowed at all is not driven for the sake of what stands: the robot brakes.
  if (around.moving.empty() && chooser.best().badness > 0.0) decision.manoeuvre = {};
  decision.command =
      limited(target_at(decision.manoeuvre, 0.0), present, settings.limits, settings.period_s);
  if (!is_same(decision.manoeuvre.first, wanted)) {
    const double gap = chooser.outcome({wanted, kHold, {}, 0.0}, true).gap_m;
    decision.hindrance =
        gap < kWantedGap ? Decision::Hindrance::kMoving : Decision::Hindrance::kStanding;
  }
  return decision;
}

}  // namespace tagfield
