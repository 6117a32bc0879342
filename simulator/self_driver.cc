#include "simulator/self_driver.h"

#include <cmath>

#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

GoalDriverSettings with_speed(GoalDriverSettings settings, double speed_m_s) {
  settings.speed_m_s = speed_m_s;
  return settings;
}

}  // namespace

std::vector<PlanarPose> goals_at(const PlanarPose& start,
                                 const std::vector<Eigen::Vector2d>& waypoints) {
  std::vector<PlanarPose> goals;
  Eigen::Vector2d from = position_of(start);
  double yaw = start.yaw;
  for (const Eigen::Vector2d& waypoint : waypoints) {
    const Eigen::Vector2d way = waypoint - from;
    if (way.norm() > 1e-6) yaw = std::atan2(way.y(), way.x());
    goals.push_back({waypoint.x(), waypoint.y(), yaw});
    from = waypoint;
  }
  return goals;
}

SelfDriver::SelfDriver(const NavigationSpec& navigation, double speed_m_s,
                       const NavigationWorld& world, const OccupancyGrid& map,
                       const PoseEstimate& start, const std::vector<PlanarPose>& goals_M,
                       std::uint64_t seed, std::uint64_t key)
    : settings_(with_speed(navigation.driver, speed_m_s)),
      senses_(world.laser, navigation.laser, navigation.odometry, seed, key),
      localizer_(map, navigation.localizer, navigation.laser.X_RL, seed ^ key),
      driver_(settings_, navigation.laser.X_RL),
      goals_(goals_M) {
  driver_.set_map(driving_map(map, world));
  localizer_.start_at(start);
}

PoseEstimate SelfDriver::believed(double seconds) const {
  return localizer_.estimate_at(senses_.odometry(seconds));
}

void SelfDriver::look_after_goals(const PlanarPose& begin_W, const PlanarPose& pose_M, Time now) {
  if (has_goal_ && driver_.state() != DriveState::kDriving) {
    outcomes_.push_back({goals_[outcomes_.size()], driver_.state(), driver_.reason(), begin_W,
                         to_seconds(now - goal_given_)});
    has_goal_ = false;
  }
  if (!has_goal_ && !finished()) {
    driver_.set_goal(goals_[outcomes_.size()], pose_M, now);
    has_goal_ = true;
    goal_given_ = now;
  }
}

BodyVelocity SelfDriver::step(const PlanarPose& begin_W, Time now, double seconds) {
  const PlanarPose pose_M = believed(senses_.present_seconds()).pose_M;
  look_after_goals(begin_W, pose_M, now);
  const BodyVelocity wanted = finished() ? BodyVelocity{} : driver_.next(pose_M, velocity_, now);
  velocity_ = limited(wanted, velocity_, settings_.limits, seconds);
  for (const SensedScan& sensed : senses_.step(begin_W, velocity_, now, seconds)) {
    localizer_.update(sensed.scan, sensed.odometry);
    driver_.see(sensed.scan, localizer_.estimate_at(sensed.odometry).pose_M);
  }
  return velocity_;
}

}  // namespace tagfield
