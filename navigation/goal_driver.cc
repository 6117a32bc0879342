#include "navigation/goal_driver.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "navigation/drive_senses.h"
#include "navigation/drive_watch.h"
#include "navigation/global_planner.h"
#include "navigation/local_planner.h"
#include "navigation/path_pursuit.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// Share of the tolerances that is aimed for.
constexpr double kAim = 0.4;
/// Share of the tolerance at which the goal is left again for a correction.
constexpr double kNearlyThere = 0.8;
/// The way ahead is watched so far for what is not on the map [m],
constexpr double kWatched = 3.0;
/// and what stands on it so long is driven around [s].
constexpr double kBlockedFor = 0.5;
constexpr double kBetweenPlans = 1.0;
/// Farther from its way than this the robot gets a new one [m].
constexpr double kAstray = 0.5;
/// Without progress for so long it tries something else [s].
constexpr double kStuckFor = 4.0;
constexpr double kBackSpeed = 0.15;
constexpr double kBackFor = 2.0;
constexpr double kLookFor = 6.0;
constexpr double kLookTurn = radians(170.0);
/// What a radian yet to be turned counts as, in metres yet to be driven.
constexpr double kMetresPerRadian = 0.3;

enum class Phase { kFollow, kFinalTurn, kLookAround, kBackUp };

bool is_finite(const PlanarPose& pose) {
  return std::isfinite(pose.x) && std::isfinite(pose.y) && std::isfinite(pose.yaw);
}

bool is_finite(const BodyVelocity& velocity) {
  return std::isfinite(velocity.forward) && std::isfinite(velocity.turn);
}

}  // namespace

struct GoalDriver::Impl {
  Impl(const GoalDriverSettings& given, const RigidTransform& X_RL)
      : settings(given), senses(X_RL, given.radius_m) {
    local.limits = given.limits;
    local.size = {given.radius_m, given.margin_m, given.clearance_m};
    local.period_s = 1.0 / given.rate_hz;
  }

  void end(DriveState how, const std::string& why);
  std::string plan_anew(const PlanarPose& pose_M, Time now);
  void take(const Plan& found);
  BodyVelocity decide_now(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);
  BodyVelocity drive(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);
  BodyVelocity stop(const BodyVelocity& velocity, const std::string& why, Time now);
  BodyVelocity wanted(const PlanarPose& pose_M, Time now);
  void follow(const PlanarPose& pose_M, Time now);
  bool has_arrived(const PlanarPose& pose_M) const;
  bool has_turned(const PlanarPose& pose_M, const BodyVelocity& velocity) const;
  double remaining_m(const PlanarPose& pose_M) const;
  void look_for_blocks(const PlanarPose& pose_M, Time now);
  void try_something_else(const PlanarPose& pose_M, Time now);
  void end_recovery(const PlanarPose& pose_M, Time now);

  GoalDriverSettings settings;
  LocalSettings local;
  DriveSenses senses;
  DriveState state = DriveState::kIdle;
  std::string reason;
  PlanarPose goal_M;
  std::vector<Eigen::Vector2d> way;
  std::optional<PathPursuit> pursuit;
  Phase phase = Phase::kFollow;
  DriveWatch watch;
  std::optional<Time> decided;  ///< When the command was.
  BodyVelocity command;
  std::optional<Decision> last;
  Hindrance hindrance = Hindrance::kNone;
  std::optional<Time> blocked_since;
  std::optional<Eigen::Vector2d> block_M;  ///< Where something stands in the way.
  Time planned;
  bool map_is_new = false;
  int attempts = 0;  ///< At something else.
  Time phase_began;
  double turned_rad = 0.0;
  double last_yaw = 0.0;
};

void GoalDriver::Impl::end(DriveState how, const std::string& why) {
  state = how;
  reason = why;
  way.clear();
  pursuit.reset();
  last.reset();
  decided.reset();
  command = {};
}

void GoalDriver::Impl::take(const Plan& found) {
  way = found.way;
  pursuit.emplace(Polyline(way), PursuitStyle{settings.limits, settings.speed_m_s, 0.4});
  blocked_since.reset();
  block_M.reset();
}

/// Looks for a way around what was seen, or, where there is none, past the map's obstacles only:
/// what was seen may go away. Returns why there is none either, and then keeps the way that it has.
std::string GoalDriver::Impl::plan_anew(const PlanarPose& pose_M, Time now) {
  planned = now;
  map_is_new = false;
  Plan found = plan(senses.map(), senses.not_on_map(), pose_M, goal_M, local.size);
  if (!found.refusal.empty()) {
    found = plan(senses.map(), {}, pose_M, goal_M, local.size);
  }
  if (!found.refusal.empty()) return found.refusal;
  const std::optional<Eigen::Vector2d> block = block_M;
  take(found);
  block_M = block;  // What was driven around may be what stops it in the end.
  return "";
}

bool GoalDriver::Impl::has_arrived(const PlanarPose& pose_M) const {
  const Eigen::Vector2d to_goal = position_of(goal_M) - position_of(pose_M);
  const double distance = to_goal.norm();
  if (distance < kAim * settings.goal_tolerance_m) return true;
  const Eigen::Vector2d heading(std::cos(pose_M.yaw), std::sin(pose_M.yaw));
  const bool is_past = to_goal.dot(heading) <= 0.0;
  const bool is_held = hindrance != Hindrance::kNone;
  return distance < kNearlyThere * settings.goal_tolerance_m && (is_past || is_held);
}

bool GoalDriver::Impl::has_turned(const PlanarPose& pose_M, const BodyVelocity& velocity) const {
  const double error = wrap_to_pi(goal_M.yaw - pose_M.yaw);
  return std::abs(error) < kAim * settings.goal_tolerance_rad && std::abs(velocity.turn) < 0.2 &&
         std::abs(velocity.forward) < 0.02;
}

double GoalDriver::Impl::remaining_m(const PlanarPose& pose_M) const {
  const double last_turn = std::abs(wrap_to_pi(goal_M.yaw - pose_M.yaw));
  if (phase == Phase::kFinalTurn) return kMetresPerRadian * last_turn;
  return pursuit->remaining_m() + kMetresPerRadian * (kPi + pursuit->to_turn_rad(pose_M));
}

/// Watches the way ahead for what stands there and is not on the map.
void GoalDriver::Impl::look_for_blocks(const PlanarPose& pose_M, Time now) {
  const double from = pursuit->along_m();
  const Polyline ahead(pursuit->way().between(from, from + kWatched));
  const double least = settings.radius_m + 0.5 * settings.margin_m;
  std::optional<Eigen::Vector2d> found;
  double found_along = kWatched;
  for (const Eigen::Vector2d& point : senses.not_on_map()) {
    if ((point - position_of(pose_M)).norm() > kWatched + 1.0) continue;
    const Polyline::Foot foot = ahead.nearest(point, 0.0, kWatched);
    if (foot.distance_m > least || foot.along_m > found_along) continue;
    found = point;
    found_along = foot.along_m;
  }
  if (found) block_M = found;
  if (!found)
    blocked_since.reset();
  else if (!blocked_since)
    blocked_since = now;
}

void GoalDriver::Impl::follow(const PlanarPose& pose_M, Time now) {
  pursuit->follow(pose_M);
  look_for_blocks(pose_M, now);
  const bool is_blocked = blocked_since && to_seconds(now - *blocked_since) >= kBlockedFor;
  const bool is_astray = pursuit->distance_m() > kAstray;
  if (!(is_blocked || is_astray || map_is_new)) return;
  if (to_seconds(now - planned) < kBetweenPlans) return;
  if (!plan_anew(pose_M, now).empty()) return;
  pursuit->follow(pose_M);
  watch.detour(remaining_m(pose_M), now);
}

/// Turns to look around and backs up by turns.
void GoalDriver::Impl::try_something_else(const PlanarPose& pose_M, Time now) {
  phase = attempts++ % 2 == 0 ? Phase::kLookAround : Phase::kBackUp;
  phase_began = now;
  turned_rad = 0.0;
  last_yaw = pose_M.yaw;
}

void GoalDriver::Impl::end_recovery(const PlanarPose& pose_M, Time now) {
  phase = Phase::kFollow;
  if (plan_anew(pose_M, now).empty()) pursuit->follow(pose_M);
  watch.tried(now);
}

/// What to drive, were nothing in the way.
BodyVelocity GoalDriver::Impl::wanted(const PlanarPose& pose_M, Time now) {
  const double lasted_s = to_seconds(now - phase_began);
  turned_rad += std::abs(wrap_to_pi(pose_M.yaw - last_yaw));
  last_yaw = pose_M.yaw;
  const bool looked =
      phase == Phase::kLookAround && (turned_rad > kLookTurn || lasted_s > kLookFor);
  const bool backed = phase == Phase::kBackUp && lasted_s > kBackFor;
  if (looked || backed) end_recovery(pose_M, now);
  if (phase == Phase::kLookAround) return {0.0, 0.5 * settings.limits.turn_rad_s};
  if (phase == Phase::kBackUp) return {-std::min(kBackSpeed, settings.limits.speed_m_s), 0.0};
  if (phase == Phase::kFollow) {
    follow(pose_M, now);
    if (has_arrived(pose_M)) phase = Phase::kFinalTurn;
  }
  if (phase == Phase::kFinalTurn) {
    const double distance = (position_of(goal_M) - position_of(pose_M)).norm();
    if (distance < settings.goal_tolerance_m) {
      return {0.0, turn_rate(wrap_to_pi(goal_M.yaw - pose_M.yaw), settings.limits)};
    }
    phase = Phase::kFollow;
    if (plan_anew(pose_M, now).empty()) watch.detour(remaining_m(pose_M), now);
    pursuit->follow(pose_M);
  }
  return pursuit->wanted(pose_M);
}

BodyVelocity GoalDriver::Impl::stop(const BodyVelocity& velocity, const std::string& why,
                                    Time now) {
  if (watch.waited_s(now) > settings.patience_s) {
    end(DriveState::kFailed, why);
    return {};
  }
  last.reset();
  return limited({}, velocity, settings.limits, local.period_s);
}

BodyVelocity GoalDriver::Impl::drive(const PlanarPose& pose_M, const BodyVelocity& velocity,
                                     Time now) {
  const BodyVelocity aim = wanted(pose_M, now);
  if (phase == Phase::kFinalTurn && has_turned(pose_M, velocity)) {
    end(DriveState::kReached, "");
    return {};
  }
  const DistanceWindow window =
      senses.window(pose_M, window_half(local),
                    local.size.least_m() + local.size.clearance_m + senses.map().resolution_m);
  const Decision decision =
      decide(pose_M, velocity, aim, senses.surroundings(window, pose_M, now), last, local);
  last = decision;
  hindrance = decision.hindrance;
  if (phase == Phase::kFollow || phase == Phase::kFinalTurn) {
    watch.update(remaining_m(pose_M), now);
    if (hindrance == Hindrance::kMoving) watch.tried(now);
    if (watch.stuck_s(now) > kStuckFor) try_something_else(pose_M, now);
  }
  return decision.command;
}

BodyVelocity GoalDriver::Impl::decide_now(const PlanarPose& pose_M, const BodyVelocity& velocity,
                                          Time now) {
  if (!is_finite(pose_M)) return stop(velocity, "the robot's pose is not finite", now);
  senses.be_at(pose_M, velocity);
  const std::string blindness = senses.blindness(now);
  if (!blindness.empty()) return stop(velocity, blindness, now);
  if (watch.waited_s(now) <= settings.patience_s) return drive(pose_M, velocity, now);
  const std::string goal = fmt::format("goal ({:.2f}, {:.2f})", goal_M.x, goal_M.y);
  std::string why = fmt::format("no nearer for {:.0f} s", settings.patience_s);
  if (hindrance == Hindrance::kMoving) {
    why = "somebody keeps moving in the way";
  } else if (block_M) {
    why = fmt::format("what is not on the map stands in the way at ({:.2f}, {:.2f})", block_M->x(),
                      block_M->y());
  }
  end(DriveState::kFailed, goal + ": " + why);
  return {};
}

GoalDriver::GoalDriver(const GoalDriverSettings& settings, const RigidTransform& X_RL)
    : impl_(std::make_unique<Impl>(settings, X_RL)) {}
GoalDriver::~GoalDriver() = default;
GoalDriver::GoalDriver(GoalDriver&&) noexcept = default;

void GoalDriver::set_map(const OccupancyGrid& map) {
  impl_->senses.set_map(map);
  impl_->map_is_new = true;
}

void GoalDriver::set_goal(const PlanarPose& goal_M, const PlanarPose& pose_M, Time now) {
  Impl& self = *impl_;
  self.end(DriveState::kIdle, "");
  self.goal_M = goal_M;
  self.block_M.reset();
  if (self.senses.map().cells.empty()) return self.end(DriveState::kRefused, "there is no map");
  const std::string refusal = self.plan_anew(pose_M, now);
  if (!refusal.empty()) return self.end(DriveState::kRefused, refusal);
  self.state = DriveState::kDriving;
  self.phase = Phase::kFollow;
  self.attempts = 0;
  self.hindrance = Hindrance::kNone;
  self.last_yaw = pose_M.yaw;
  self.pursuit->follow(pose_M);
  self.watch.begin(self.remaining_m(pose_M), now);
}

void GoalDriver::cancel() { impl_->end(DriveState::kIdle, ""); }

void GoalDriver::see(const LaserScan& scan, const PlanarPose& pose_M) {
  impl_->senses.see(scan, pose_M);
}

BodyVelocity GoalDriver::next(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now) {
  Impl& self = *impl_;
  if (self.state != DriveState::kDriving) return {};
  if (self.decided && now < *self.decided) {
    // Time has gone back: all that was timed begins anew, and nothing that was seen counts.
    self.senses.forget();
    self.watch.begin(1e9, now);
    self.planned = now;
    self.phase_began = now;
    self.blocked_since.reset();
    self.decided.reset();
  }
  // A little less than the period, so that a caller's rounded stamps don't make it one step longer.
  const Duration period = duration_from_seconds(0.999 * self.local.period_s);
  if (self.decided && now - *self.decided < period) return self.command;
  self.decided = now;
  const BodyVelocity present = is_finite(velocity) ? velocity : self.command;
  const BodyVelocity command = self.decide_now(pose_M, present, now);
  if (self.state == DriveState::kDriving) self.command = command;
  return self.state == DriveState::kDriving ? command : BodyVelocity{};
}

DriveState GoalDriver::state() const { return impl_->state; }
const std::string& GoalDriver::reason() const { return impl_->reason; }
const std::vector<Eigen::Vector2d>& GoalDriver::path() const { return impl_->way; }

}  // namespace tagfield
