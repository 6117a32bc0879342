// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/wander.h"

#include <algorithm>
#include <cmath>

#include "tagfield/base/trigonometry.h"
#include "tagfield/base/units.h"
#include "tagfield/motion/planar_pose.h"
#include "tagfield/navigation/scan_points.h"

namespace tagfield {
namespace {

/// How far ahead directions are checked, and how far one is driven before the next is chosen [m].
constexpr double kSight = 4.0;
constexpr double kLeg = 3.0;
/// Length left undriven at the end of a free section, and the least length worth driving [m].
constexpr double kSpare = 0.3;
constexpr double kMinWay = 0.8;
/// Kept free to the sides, beyond the robot's margin: its path is not quite straight [m].
constexpr double kBeside = 0.05;
/// What was seen from a position holds within this distance of it [m].
constexpr double kSameGoal = 0.5;
/// Cost of a radian of turning, and of each crumb within kNearCrumb of the end [m].
constexpr double kTurnCost = 0.4;
constexpr double kPerCrumb = 1.0;
constexpr int kMaxCrumbs = 3;
constexpr double kNearCrumb = 1.2;
constexpr double kCrumbSpacing = 1.0;
constexpr std::size_t kCrumbsKept = 40;
/// At the edges of its field of view a laser does not see how wide a passage is.
constexpr double kEdge = radians(10.0);
constexpr int kThirds = 3;
constexpr double kBetweenChoices = 0.5;  ///< [s]
constexpr double kFloorHalf = 8.0;       ///< Half the side of the floor used for planning [m].
constexpr double kFloorCell = 0.1;

/// The exact end pose does not matter much.
GoalDriverSettings careless(GoalDriverSettings settings) {
  settings.goal_tolerance_m = 0.2;
  settings.goal_tolerance_rad = 0.3;
  settings.patience_s = 6.0;
  return settings;
}

constexpr std::size_t kSectors = 48;
double yaw_of_sector(std::size_t sector) {
  return static_cast<double>(sector) * kTwoPi / static_cast<double>(kSectors);
}

Eigen::Vector2d direction_of(double yaw) { return {cosine(yaw), sine(yaw)}; }

/// Whether the beam nearest to `angle_L` is valid and not too near to the first or the last.
bool is_in_view(const LaserScan& scan, double angle_L) {
  if (!(scan.angle_step_rad > 0.0) || scan.ranges_m.empty()) return false;
  const double last = static_cast<double>(scan.ranges_m.size() - 1);
  const double middle = scan.first_angle_rad + 0.5 * last * scan.angle_step_rad;
  const double aside = wrap_to_pi(angle_L - middle);
  if (std::abs(aside) > 0.5 * last * scan.angle_step_rad - kEdge) return false;
  const double beam = std::clamp(0.5 * last + aside / scan.angle_step_rad, 0.0, last);
  const auto i = static_cast<std::size_t>(std::lround(beam));
  return beam_of(scan, scan.ranges_m[i]) != Beam::kInvalid;
}

OccupancyGrid empty_floor(const Eigen::Vector2d& middle) {
  OccupancyGrid floor;
  floor.resolution_m = kFloorCell;
  floor.width = floor.height = static_cast<int>(std::lround(2.0 * kFloorHalf / kFloorCell));
  floor.origin = middle - Eigen::Vector2d::Constant(kFloorHalf);
  floor.cells.assign(static_cast<std::size_t>(floor.width) * static_cast<std::size_t>(floor.height),
                     0);
  return floor;
}

void mark(OccupancyGrid& floor, const std::vector<Eigen::Vector2d>& points) {
  for (const Eigen::Vector2d& point : points) {
    const Eigen::Vector2i cell = floor.cell_of(point);
    if (floor.contains(cell.x(), cell.y())) floor.cells[floor.index(cell.x(), cell.y())] = 100;
  }
}

}  // namespace

double free_distance(const std::vector<Eigen::Vector2d>& points_R, double angle_rad,
                     double half_width_m, double max_m) {
  const Eigen::Vector2d along = direction_of(angle_rad);
  double way = max_m;
  for (const Eigen::Vector2d& p : points_R) {
    const double ahead = along.dot(p);
    const double aside = along.x() * p.y() - along.y() * p.x();
    if (ahead <= 0.0 || std::abs(aside) >= half_width_m || p.norm() <= half_width_m) continue;
    way = std::min(way, ahead - std::sqrt(half_width_m * half_width_m - aside * aside));
  }
  return std::max(way, 0.0);
}

Wander::Wander(const GoalDriverSettings& settings, const RigidTransform& X_RL)
    : X_RL_(X_RL),
      radius_m_(settings.radius_m),
      half_width_m_(settings.radius_m + settings.margin_m + kBeside),
      driver_(careless(settings), X_RL) {
  begin();
}

void Wander::begin() {
  driver_.cancel();
  driver_.forget();
  rooms_.assign(kSectors, {});
  ends_O_.clear();
  hidden_O_.clear();
  has_seen_ = false;
  crumbs_O_.clear();
  turns_left_ = kThirds;
  chosen_.reset();
}

void Wander::see(const LaserScan& scan, const PlanarPose& pose_O) {
  if (!is_finite(pose_O)) return;
  driver_.see(scan, pose_O);
  has_seen_ = true;
  const std::vector<Eigen::Vector2d> ends_R = scan_points(scan, X_RL_, 0.0).ends_R;
  ends_O_.clear();
  for (const Eigen::Vector2d& end_R : ends_R) ends_O_.push_back(transformed(pose_O, end_R));
  for (std::size_t i = 0; i < kSectors; ++i) {
    const double angle_R = yaw_of_sector(i) - pose_O.yaw;
    if (!is_in_view(scan, angle_R - yaw_of(X_RL_.rotation))) continue;
    rooms_[i] = {free_distance(ends_R, angle_R, half_width_m_, kSight), position_of(pose_O)};
  }
}

/// 0 if nothing is known about that direction from near here.
double Wander::way_towards(std::size_t sector, const Eigen::Vector2d& here_O) const {
  const Room& room = rooms_[sector];
  if ((room.from_O - here_O).norm() > kSameGoal) return 0.0;
  std::vector<Eigen::Vector2d> hidden;
  for (const Eigen::Vector2d& p_O : hidden_O_) {
    if ((p_O - here_O).norm() < kSight + half_width_m_) hidden.emplace_back(p_O - here_O);
  }
  return free_distance(hidden, yaw_of_sector(sector), half_width_m_, room.way_m);
}

double Wander::gain(std::size_t sector, double way, const PlanarPose& pose_O) const {
  const double yaw = yaw_of_sector(sector);
  const Eigen::Vector2d here = position_of(pose_O);
  const Eigen::Vector2d end = here + std::min(way, kLeg) * direction_of(yaw);
  const auto crumbs =
      std::count_if(crumbs_O_.begin(), crumbs_O_.end(),
                    [&](const Eigen::Vector2d& p) { return (p - end).norm() < kNearCrumb; });
  return way - kTurnCost * std::abs(wrap_to_pi(yaw - pose_O.yaw)) -
         kPerCrumb * std::min(static_cast<int>(crumbs), kMaxCrumbs);
}

void Wander::go(const PlanarPose& goal_O, const PlanarPose& pose_O, bool is_turn, Time now) {
  goal_O_ = position_of(goal_O);
  OccupancyGrid floor = empty_floor(position_of(pose_O));
  // A turn on the spot does not need the clearance that a goal must have.
  if (!is_turn) {
    mark(floor, ends_O_);
    mark(floor, hidden_O_);
  }
  driver_.set_map(floor);
  driver_.set_goal(goal_O, pose_O, now);
}

/// Hidden points that include one where the robot stands are all considered wrong.
void Wander::doubt_hidden(const Eigen::Vector2d& here_O) {
  const bool is_wrong =
      std::any_of(hidden_O_.begin(), hidden_O_.end(),
                  [&](const Eigen::Vector2d& p_O) { return (p_O - here_O).norm() < radius_m_; });
  if (is_wrong) hidden_O_.clear();
}

void Wander::choose(const PlanarPose& pose_O, Time now) {
  chosen_ = now;
  doubt_hidden(position_of(pose_O));
  if (turns_left_ > 0) {
    --turns_left_;
    const double yaw = wrap_to_pi(pose_O.yaw + kTwoPi / kThirds);
    return go({pose_O.x, pose_O.y, yaw}, pose_O, true, now);
  }
  std::optional<std::size_t> best;
  double best_way = 0.0;
  double best_gain = 0.0;
  for (std::size_t i = 0; i < kSectors; ++i) {
    const double way = way_towards(i, position_of(pose_O));
    const double here = gain(i, way, pose_O);
    if (way < kMinWay || (best && here <= best_gain)) continue;
    best = i;
    best_way = way;
    best_gain = here;
  }
  if (!best) {
    turns_left_ = kThirds;
    return;
  }
  const double yaw = yaw_of_sector(*best);
  const Eigen::Vector2d goal =
      position_of(pose_O) + (std::min(best_way, kLeg) - kSpare) * direction_of(yaw);
  go({goal.x(), goal.y(), yaw}, pose_O, false, now);
}

BodyVelocity Wander::next(const PlanarPose& pose_O, const BodyVelocity& velocity, Time now) {
  if (!is_finite(pose_O)) return {};
  const Eigen::Vector2d here = position_of(pose_O);
  if (crumbs_O_.empty() || (crumbs_O_.back() - here).norm() > kCrumbSpacing) {
    crumbs_O_.push_back(here);
  }
  if (crumbs_O_.size() > kCrumbsKept) crumbs_O_.pop_front();
  if (chosen_ && now < *chosen_) chosen_.reset();
  const bool is_due = !chosen_ || to_seconds(now - *chosen_) >= kBetweenChoices;
  if (driver_.state() != DriveState::kDriving && is_due && has_seen_) {
    const bool has_given_up =
        driver_.state() == DriveState::kFailed || driver_.state() == DriveState::kRefused;
    if (has_given_up) crumbs_O_.push_back(goal_O_);
    if (driver_.state() == DriveState::kRefused) turns_left_ = kThirds;
    choose(pose_O, now);
  }
  return driver_.next(pose_O, velocity, now);
}

}  // namespace tagfield
