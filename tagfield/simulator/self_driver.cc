// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/self_driver.h"

#include "tagfield/base/trigonometry.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

GoalDriverSettings with_speed(GoalDriverSettings settings, double speed_m_s) {
  settings.speed_m_s = speed_m_s;
  return settings;
}

/// Beliefs wider than this are useless: the driver keeps clear of walls by centimetres.
constexpr double kMaxSigma_m = 0.3;
constexpr double kMaxSigma_rad = 0.2;

/// While wandering, the robot avoids unseen obstacles within this radius [m], which is longer than
/// a path.
constexpr double kHiddenWithin_m = 5.0;

/// While less than this share of a scan fits the map, the robot believes neither that a goal is
/// reached nor that it can't be. It is the localizer's own limit, which waits for several such
/// scans.
constexpr double kDoubtfulFit = 0.5;

/// Cell centres where `full` is occupied and `map`, with the same cells, is not.
std::vector<Eigen::Vector2d> occupied_beside(const OccupancyGrid& full, const OccupancyGrid& map) {
  std::vector<Eigen::Vector2d> places;
  for (int y = 0; y < full.height; ++y) {
    for (int x = 0; x < full.width; ++x) {
      if (is_occupied(full.at(x, y)) && !is_occupied(map.at(x, y))) {
        places.push_back(full.centre_of(x, y));
      }
    }
  }
  return places;
}

bool is_sure(const MonteCarloLocalizer& localizer, const PoseEstimate& estimate) {
  const Eigen::Vector3d variance = estimate.covariance.diagonal();
  return localizer.state() == Localization::kTracking &&
         variance.head<2>().sum() <= kMaxSigma_m * kMaxSigma_m &&
         variance.z() <= kMaxSigma_rad * kMaxSigma_rad;
}

}  // namespace

std::vector<PlanarPose> goals_at(const PlanarPose& start,
                                 const std::vector<Eigen::Vector2d>& waypoints) {
  std::vector<PlanarPose> goals;
  Eigen::Vector2d from = position_of(start);
  double yaw = start.yaw;
  for (const Eigen::Vector2d& waypoint : waypoints) {
    const Eigen::Vector2d way = waypoint - from;
    if (way.norm() > 1e-6) yaw = arc_tangent(way.y(), way.x());
    goals.push_back({waypoint.x(), waypoint.y(), yaw});
    from = waypoint;
  }
  return goals;
}

SelfDriver::SelfDriver(const NavigationSpec& navigation, double speed_m_s,
                       const NavigationWorld& world, const OccupancyGrid& map, const HitGrid* walls,
                       const std::optional<PoseEstimate>& start,
                       const std::vector<PlanarPose>& goals_M, std::uint64_t seed,
                       std::uint64_t key)
    : settings_(with_speed(navigation.driver, speed_m_s)),
      senses_(world.laser, navigation.laser, navigation.odometry, seed, key),
      localizer_(map, navigation.localizer, navigation.laser.X_RL, seed ^ key, walls),
      driver_(settings_, navigation.laser.X_RL),
      wander_(settings_, navigation.laser.X_RL),
      goals_(goals_M) {
  const OccupancyGrid full = driving_map(map, world);
  driver_.set_map(full);
  hidden_M_ = occupied_beside(full, map);
  if (start) localizer_.start_at(*start);
  knows_position_ = start.has_value();
}

PoseEstimate SelfDriver::believed(double seconds) const {
  return localizer_.estimate_at(senses_.odometry(seconds));
}

PlanarPose SelfDriver::believed_at(const SensedScan& sensed) const {
  return localizer_.estimate_at(sensed.odometry).pose_M;
}

double SelfDriver::progress() const {
  return goals_.empty()
             ? 1.0
             : static_cast<double>(outcomes_.size()) / static_cast<double>(goals_.size());
}

/// When the pose is found again, observations made with a wrong belief are discarded, as they would
/// be at wrong positions.
void SelfDriver::look_after_place(Time now) {
  const bool knows = is_sure(localizer_, believed(senses_.present_seconds()));
  if (knows == knows_position_) return;
  knows_position_ = knows;
  if (knows) {
    driver_.forget();
  } else {
    driver_.cancel();
    wander_.begin();
    lost_since_ = now;
  }
  is_under_way_ = false;
}

void SelfDriver::end_goal(DriveState state, const std::string& reason, const PlanarPose& begin_W,
                          Time now) {
  outcomes_.push_back({goals_[outcomes_.size()], state, reason, begin_W,
                       to_seconds(now - goal_given_.value_or(now))});
  goal_given_.reset();
  is_under_way_ = false;
  has_doubted_ = false;
}

/// Once per goal the robot restarts global localization before it ends the goal.
bool SelfDriver::doubts_place() {
  if (!has_looked_ || has_doubted_ || localizer_.fit() >= kDoubtfulFit) return false;
  has_doubted_ = true;
  localizer_.start_anywhere();
  return true;
}

void SelfDriver::look_after_goals(const PlanarPose& begin_W, const PlanarPose& pose_M, Time now) {
  if (is_under_way_ && driver_.state() != DriveState::kDriving) {
    if (doubts_place()) return;
    end_goal(driver_.state(), driver_.reason(), begin_W, now);
  }
  if (is_under_way_ || finished()) return;
  if (!goal_given_) goal_given_ = now;
  driver_.set_goal(goals_[outcomes_.size()], pose_M, now);
  is_under_way_ = true;
}

/// According to the best guess of the pose. Places in a hall that look alike have similar racks.
std::vector<Eigen::Vector2d> SelfDriver::hidden_things(const PlanarPose& odometry) const {
  const PlanarPose guess_M = localizer_.estimate_at(odometry).pose_M;
  std::vector<Eigen::Vector2d> hidden_O;
  for (const Eigen::Vector2d& p_M : hidden_M_) {
    if ((p_M - position_of(guess_M)).norm() > kHiddenWithin_m) continue;
    const PlanarPose p_R = between(guess_M, {p_M.x(), p_M.y(), 0.0});
    hidden_O.push_back(transformed(odometry, position_of(p_R)));
  }
  return hidden_O;
}

BodyVelocity SelfDriver::wanted(const PlanarPose& begin_W, Time now) {
  if (finished()) return {};
  if (!knows_position_) {
    if (!goal_given_) goal_given_ = now;
    if (to_seconds(now - lost_since_) <= kSearchLimit_s) {
      const PlanarPose odometry = senses_.odometry(senses_.present_seconds());
      if (has_looked_) wander_.mind(hidden_things(odometry));
      return wander_.next(odometry, velocity_, now);
    }
    while (!finished()) {
      end_goal(DriveState::kFailed, "the robot does not know where it is", begin_W, now);
    }
    return {};
  }
  const PlanarPose pose_M = believed(senses_.present_seconds()).pose_M;
  look_after_goals(begin_W, pose_M, now);
  return driver_.next(pose_M, velocity_, now);
}

BodyVelocity SelfDriver::step(const PlanarPose& begin_W, Time now, double seconds) {
  look_after_place(now);
  velocity_ = limited(wanted(begin_W, now), velocity_, settings_.limits, seconds);
  scans_ = senses_.step(begin_W, velocity_, now, seconds);
  for (const SensedScan& sensed : scans_) {
    has_looked_ = localizer_.update(sensed.scan, sensed.odometry) || has_looked_;
    if (knows_position_) {
      driver_.see(sensed.scan, believed_at(sensed));
    } else {
      wander_.see(sensed.scan, sensed.odometry);
    }
  }
  return velocity_;
}

}  // namespace tagfield
