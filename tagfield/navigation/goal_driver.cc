// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/goal_driver.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

#include "tagfield/base/error.h"
#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/drive_route.h"
#include "tagfield/navigation/drive_senses.h"
#include "tagfield/navigation/drive_watch.h"
#include "tagfield/navigation/local_planner.h"
#include "tagfield/navigation/recovery.h"

namespace tagfield {
namespace {

/// Fraction of the tolerances that the robot aims for.
constexpr double kAim = 0.4;
/// Fraction of the tolerance that is good enough if the robot has passed the goal or is held up.
constexpr double kNearlyThere = 0.8;
/// Time without progress before it tries something else [s].
constexpr double kStuckFor = 4.0;
/// Metres yet to be driven that a radian yet to be turned counts as.
constexpr double kMetresPerRadian = 0.3;
/// A robot that turns or drives faster than this has not arrived yet [rad/s, m/s].
constexpr double kStillTurn = 0.2;
constexpr double kStillForward = 0.02;
constexpr double kLookAhead = 0.4;

bool is_finite(const BodyVelocity& velocity) {
  return std::isfinite(velocity.forward) && std::isfinite(velocity.turn);
}

void check(const char* name, double value, bool may_be_zero) {
  if (std::isfinite(value) && (value > 0.0 || (may_be_zero && value == 0.0))) return;
  throw Error(fmt::format("{}: {}, expected a number {} 0", name, value, may_be_zero ? "≥" : ">"));
}

const GoalDriverSettings& checked(const GoalDriverSettings& settings) {
  check("speed", settings.speed_m_s, false);
  check("radius", settings.radius_m, false);
  check("margin", settings.margin_m, true);
  check("clearance", settings.clearance_m, true);
  check("goal_tolerance", settings.goal_tolerance_m, false);
  check("goal_tolerance of the heading", settings.goal_tolerance_rad, false);
  check("rate", settings.rate_hz, false);
  check("patience", settings.patience_s, false);
  check("limit of speed", settings.limits.speed_m_s, false);
  check("limit of turning", settings.limits.turn_rad_s, false);
  check("limit of acceleration", settings.limits.acceleration_m_s2, false);
  check("limit of turning's acceleration", settings.limits.turn_acceleration_rad_s2, false);
  return settings;
}

}  // namespace

struct GoalDriver::Impl {
  Impl(const GoalDriverSettings& given, const RigidTransform& X_RL)
      : settings(checked(given)),
        local{
            given.limits, {given.radius_m, given.margin_m, given.clearance_m}, 1.0 / given.rate_hz},
        senses(X_RL, given.radius_m),
        route(local.size, {given.limits, given.speed_m_s, kLookAhead}) {}

  void end(DriveState how, const std::string& why);
  void rewind(Time now);
  BodyVelocity decide_now(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);
  BodyVelocity drive(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now);
  BodyVelocity stop(const BodyVelocity& velocity, const std::string& why, Time now);
  BodyVelocity wanted(const PlanarPose& pose_M, Time now);
  void look_after_progress(const PlanarPose& pose_M, Time now);
  [[nodiscard]] bool has_arrived(const PlanarPose& pose_M) const;
  [[nodiscard]] bool has_turned(const PlanarPose& pose_M, const BodyVelocity& velocity) const;
  [[nodiscard]] double remaining_m(const PlanarPose& pose_M) const;
  [[nodiscard]] std::string why_no_nearer() const;

  GoalDriverSettings settings;
  LocalSettings local;
  DriveSenses senses;
  DriveRoute route;
  DriveWatch watch;
  Recovery recovery;
  DriveState state = DriveState::kIdle;
  std::string reason;
  PlanarPose goal_M;
  bool is_there = false;        ///< At the goal, turning to its heading.
  std::optional<Time> decided;  ///< When `command` was decided.
  BodyVelocity command;
  std::optional<Decision> last;
};

void GoalDriver::Impl::end(DriveState how, const std::string& why) {
  state = how;
  reason = why;
  route.clear();
  recovery.reset();
  last.reset();
  decided.reset();
  command = {};
  is_there = false;
}

/// Time has jumped back: restarts all timers and forgets all that was seen.
void GoalDriver::Impl::rewind(Time now) {
  senses.forget();
  route.rewind(now);
  recovery.reset();
  watch.begin(route.pursuit().way().length_m() + 10.0, now);
  decided.reset();
}

bool GoalDriver::Impl::has_arrived(const PlanarPose& pose_M) const {
  const Eigen::Vector2d to_goal = position_of(goal_M) - position_of(pose_M);
  const double distance = to_goal.norm();
  if (distance < kAim * settings.goal_tolerance_m) return true;
  const Eigen::Vector2d heading(cosine(pose_M.yaw), sine(pose_M.yaw));
  const bool is_past = to_goal.dot(heading) <= 0.0;
  const bool is_held = last && last->hindrance != Hindrance::kNone;
  return distance < kNearlyThere * settings.goal_tolerance_m && (is_past || is_held);
}

bool GoalDriver::Impl::has_turned(const PlanarPose& pose_M, const BodyVelocity& velocity) const {
  const double error = wrap_to_pi(goal_M.yaw - pose_M.yaw);
  return std::abs(error) < kAim * settings.goal_tolerance_rad &&
         std::abs(velocity.turn) < kStillTurn && std::abs(velocity.forward) < kStillForward;
}

double GoalDriver::Impl::remaining_m(const PlanarPose& pose_M) const {
  if (is_there) return kMetresPerRadian * std::abs(wrap_to_pi(goal_M.yaw - pose_M.yaw));
  // The turn at the goal, at most half a turn, comes after the whole path.
  return route.pursuit().remaining_m() +
         kMetresPerRadian * (kPi + route.pursuit().to_turn_rad(pose_M));
}

/// The velocity to drive if nothing is in the way.
BodyVelocity GoalDriver::Impl::wanted(const PlanarPose& pose_M, Time now) {
  if (recovery.is_on()) {
    const std::optional<BodyVelocity> tried = recovery.wanted(pose_M, now, settings.limits);
    if (tried) return *tried;
    route.plan_anew(senses, pose_M, now);
    watch.tried(now);
  }
  const double distance = (position_of(goal_M) - position_of(pose_M)).norm();
  if (is_there && distance > settings.goal_tolerance_m) {
    is_there = false;
    route.plan_anew(senses, pose_M, now);
  }
  if (!is_there) {
    if (route.follow(senses, pose_M, now)) watch.detour(remaining_m(pose_M), now);
    is_there = has_arrived(pose_M);
  }
  if (is_there) return {0.0, turn_rate(wrap_to_pi(goal_M.yaw - pose_M.yaw), settings.limits)};
  return route.pursuit().wanted(pose_M);
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

void GoalDriver::Impl::look_after_progress(const PlanarPose& pose_M, Time now) {
  if (recovery.is_on()) return;
  watch.update(remaining_m(pose_M), now);
  // People who walk go away by themselves.
  if (last->hindrance == Hindrance::kMoving) watch.tried(now);
  if (watch.stuck_s(now) > kStuckFor) recovery.begin(pose_M, now);
}

BodyVelocity GoalDriver::Impl::drive(const PlanarPose& pose_M, const BodyVelocity& velocity,
                                     Time now) {
  const BodyVelocity aim = wanted(pose_M, now);
  if (is_there && has_turned(pose_M, velocity)) {
    end(DriveState::kReached, "");
    return {};
  }
  const DistanceWindow window =
      senses.window(pose_M, window_half(local), local.size.min_m() + local.size.clearance_m);
  last = decide(pose_M, velocity, aim, senses.surroundings(window, pose_M, now), last, local);
  look_after_progress(pose_M, now);
  return last->command;
}

std::string GoalDriver::Impl::why_no_nearer() const {
  if (!route.refusal().empty()) return route.refusal();
  std::string why = fmt::format("no nearer for {:.0f} s", settings.patience_s);
  const std::optional<Eigen::Vector2d>& block = route.block_M();
  if (last && last->hindrance == Hindrance::kMoving) {
    why = "something keeps moving across the path";
  } else if (block) {
    why = fmt::format("an obstacle that is not on the map blocks the path at ({:.2f}, {:.2f})",
                      block->x(), block->y());
  }
  return fmt::format("goal ({:.2f}, {:.2f}): {}", goal_M.x, goal_M.y, why);
}

BodyVelocity GoalDriver::Impl::decide_now(const PlanarPose& pose_M, const BodyVelocity& velocity,
                                          Time now) {
  if (!is_finite(pose_M)) return stop(velocity, "the robot's pose is not finite", now);
  senses.be_at(pose_M, velocity);
  const std::string blindness = senses.blindness(now);
  if (!blindness.empty()) return stop(velocity, blindness, now);
  if (watch.waited_s(now) <= settings.patience_s) return drive(pose_M, velocity, now);
  end(DriveState::kFailed, why_no_nearer());
  return {};
}

GoalDriver::GoalDriver(const GoalDriverSettings& settings, const RigidTransform& X_RL)
    : impl_(std::make_unique<Impl>(settings, X_RL)) {}
GoalDriver::~GoalDriver() = default;
GoalDriver::GoalDriver(GoalDriver&&) noexcept = default;

void GoalDriver::set_map(const OccupancyGrid& map) {
  impl_->senses.set_map(map);
  impl_->route.map_changed();
}

void GoalDriver::set_goal(const PlanarPose& goal_M, const PlanarPose& pose_M, Time now) {
  Impl& self = *impl_;
  self.end(DriveState::kIdle, "");
  self.goal_M = goal_M;
  if (self.senses.map().cells.empty()) return self.end(DriveState::kRefused, "there is no map");
  const std::string refusal = self.route.begin(self.senses, pose_M, goal_M, now);
  if (!refusal.empty()) return self.end(DriveState::kRefused, refusal);
  self.state = DriveState::kDriving;
  self.watch.begin(self.remaining_m(pose_M), now);
}

void GoalDriver::cancel() { impl_->end(DriveState::kIdle, ""); }

void GoalDriver::forget() { impl_->senses.forget(); }

void GoalDriver::see(const LaserScan& scan, const PlanarPose& pose_M) {
  impl_->senses.see(scan, pose_M);
}

BodyVelocity GoalDriver::next(const PlanarPose& pose_M, const BodyVelocity& velocity, Time now) {
  Impl& self = *impl_;
  if (self.state != DriveState::kDriving) return {};
  if (self.decided && now < *self.decided) self.rewind(now);
  // A little less than the period, so that a caller's rounded stamps don't make it one step longer.
  const Duration period = duration_from_seconds(0.999 * self.local.period_s);
  if (self.decided && now - *self.decided < period) return self.command;
  self.decided = now;
  const BodyVelocity command =
      self.decide_now(pose_M, is_finite(velocity) ? velocity : self.command, now);
  // If that has ended the drive, the command is already to stand.
  if (self.state == DriveState::kDriving) self.command = command;
  return self.command;
}

DriveState GoalDriver::state() const { return impl_->state; }
const std::string& GoalDriver::reason() const { return impl_->reason; }
const std::vector<Eigen::Vector2d>& GoalDriver::path() const { return impl_->route.way(); }

}  // namespace tagfield
