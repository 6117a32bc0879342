// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/robot_senses.h"

#include <algorithm>

#include "tagfield/base/random.h"
#include "tagfield/laser/deskew.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {

RobotSenses::RobotSenses(const LaserWorld& world, const LaserParameters& laser,
                         const OdometryNoise& noise, std::uint64_t seed, std::uint64_t key)
    : world_(world), laser_(laser), noise_(noise), seed_(seed), key_(key) {
  check(laser_);
  check(noise_);
}

std::vector<SensedScan> RobotSenses::step(const PlanarPose& begin_W, const BodyVelocity& velocity,
                                          Time now, double seconds) {
  Motion motion{now, seconds, begin_W, velocity, {}, {}};
  motion.begin_O = odometry(present_seconds());
  RandomStream stream(seed_, Purpose::kWheelOdometry, key_, steps_++);
  motion.increment =
      noisy_increment(between(begin_W, advance(begin_W, velocity, seconds)), noise_, stream);
  motions_.push_back(motion);
  const Duration sweep = duration_from_seconds(laser_.sweep_s);
  while (motions_.size() > 1 &&
         motions_[1].begin + duration_from_seconds(motions_[1].seconds) < now - sweep) {
    motions_.pop_front();
  }
  std::vector<SensedScan> scans;
  const Time end = now + duration_from_seconds(seconds);
  while (scan_stamp(laser_, next_scan_) + sweep < now) ++next_scan_;
  for (; scan_stamp(laser_, next_scan_) + sweep < end; ++next_scan_) {
    // Scans that began before the recorded motion are left out.
    if (scan_stamp(laser_, next_scan_) >= motions_.front().begin) scans.push_back(scan(next_scan_));
  }
  return scans;
}

const RobotSenses::Motion& RobotSenses::motion_at(Time stamp) const {
  const auto after =
      std::upper_bound(motions_.begin(), motions_.end(), stamp,
                       [](Time t, const Motion& motion) { return t < motion.begin; });
  return after == motions_.begin() ? *after : *std::prev(after);
}

PlanarPose RobotSenses::true_pose_at(Time stamp) const {
  const Motion& motion = motion_at(stamp);
  return advance(motion.begin_W, motion.velocity, to_seconds(stamp - motion.begin));
}

PlanarPose RobotSenses::odometry_at(Time stamp) const {
  const Motion& motion = motion_at(stamp);
  const double share = to_seconds(stamp - motion.begin) / motion.seconds;
  const PlanarPose& whole = motion.increment;
  return compose(motion.begin_O, {whole.x * share, whole.y * share, whole.yaw * share});
}

PlanarPose RobotSenses::odometry(double seconds) const {
  if (motions_.empty()) return {};
  return odometry_at(motions_.back().begin + duration_from_seconds(seconds));
}

SensedScan RobotSenses::scan(std::int64_t number) const {
  const auto pose_at = [this](Time stamp) { return to_transform(true_pose_at(stamp)); };
  const auto obstacles = [this](Time stamp) { return obstacles_at(world_.obstacles, stamp); };
  const LaserScan raw = simulate_scan(
      *world_.rays, laser_, number, pose_at,
      world_.obstacles.empty() ? nullptr : std::function<Obstacles(Time)>(obstacles), seed_, key_);
  SensedScan sensed;
  sensed.scan = deskewed(
      raw, [this](Time stamp) { return odometry_at(stamp); }, laser_.X_RL);
  sensed.odometry = odometry_at(sensed.scan.stamp);
  return sensed;
}

}  // namespace tagfield
