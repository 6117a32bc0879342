// SPDX-License-Identifier: Apache-2.0
#include "tagfield/navigation/drive_senses.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/error.h"
#include "tagfield/motion/planar_pose.h"

namespace tagfield {
namespace {

/// A return is on the map if an occupied cell is nearer than this. Allows for the cell size, the
/// errors of map and pose, and, per metre of range, the error of the yaw.
constexpr double kOnMapWithin = 0.15;
constexpr double kOnMapPerMetre = 0.01;
/// Maximum age of a usable scan, or time ahead of now [s].
constexpr double kFresh = 0.5;
/// Least fraction of a scan's beams that must be valid.
constexpr double kMinValid = 0.1;
constexpr double kTrailSpacing = 0.1;
constexpr std::size_t kTrailPoints = 60;
/// Added to the robot's radius, within which the floor is free where it has been: its trail has
/// gaps [m].
constexpr double kTrodden = 0.02;
/// Added to a moving obstacle's radius when its points are forgotten [m].
constexpr double kAround = 0.1;

}  // namespace

void DriveSenses::set_map(const OccupancyGrid& map) {
  if (map.width <= 0 || map.height <= 0) throw Error("map: has no cells");
  if (!(map.resolution_m > 0.0) || !std::isfinite(map.resolution_m) || !map.origin.allFinite()) {
    throw Error("map: resolution or origin is not a usable number");
  }
  const auto cells = static_cast<std::size_t>(map.width) * static_cast<std::size_t>(map.height);
  if (map.cells.size() != cells) {
    throw Error(
        fmt::format("map: {} cells, expected {} × {}", map.cells.size(), map.width, map.height));
  }
  map_ = map;
  std::vector<bool> is_source(cells);
  std::transform(map.cells.begin(), map.cells.end(), is_source.begin(), is_occupied);
  to_occupied_ = distance_field(map, is_source, kMaxToMap);
}

void DriveSenses::forget() {
  memory_.clear();
  tracker_.clear();
  last_scan_.reset();
  may_be_M_.clear();
  trail_M_.clear();
}

double DriveSenses::distance_to_map(const Eigen::Vector2d& p_M) const {
  return distance_of_cell(map_.cell_of(p_M));
}

double DriveSenses::distance_of_cell(const Eigen::Vector2i& cell) const {
  if (!map_.contains(cell.x(), cell.y())) return kMaxToMap;
  return static_cast<double>(to_occupied_[map_.index(cell.x(), cell.y())]);
}

void DriveSenses::see(const LaserScan& scan, const PlanarPose& pose_M) {
  if (!is_finite(pose_M)) return;
  if (last_scan_ && scan.stamp < *last_scan_) forget();
  const ScanInMap seen = scan_in_map(scan, X_RL_, pose_M, velocity_);
  std::vector<bool> is_on_map(seen.returns.size());
  std::vector<bool> may_move(seen.returns.size());
  for (std::size_t i = 0; i < seen.returns.size(); ++i) {
    const ScanReturn& hit = seen.returns[i];
    const Eigen::Vector2i cell = map_.cell_of(hit.point_M);
    is_on_map[i] = distance_of_cell(cell) < kOnMapWithin + kOnMapPerMetre * hit.range_m;
    // In unknown space any wall that comes into view would seem to move.
    may_move[i] = !is_on_map[i] && map_.at(cell.x(), cell.y()) >= 0;
  }
  const std::vector<bool> moves = tracker_.update(seen, may_move);
  memory_.see(seen, is_on_map, moves);
  for (const MovingObstacle& moving : tracker_.moving(scan.stamp)) {
    memory_.forget_around(moving.centre_M, moving.radius_m + kAround);
  }
  last_scan_ = scan.stamp;
  valid_share_ = seen.valid_share;
  may_be_M_ = seen.may_be_M;
}

void DriveSenses::be_at(const PlanarPose& pose_M, const BodyVelocity& velocity) {
  velocity_ = velocity;
  const Eigen::Vector2d here = position_of(pose_M);
  if (!trail_M_.empty() && (trail_M_.back() - here).norm() < kTrailSpacing) return;
  trail_M_.push_back(here);
  if (trail_M_.size() > kTrailPoints) trail_M_.pop_front();
}

std::string DriveSenses::blindness(Time now) const {
  if (!last_scan_) return "there is no laser scan";
  const double age_s = to_seconds(now - *last_scan_);
  if (std::abs(age_s) > kFresh) {
    return fmt::format("the last laser scan is {:.1f} s {}", std::abs(age_s),
                       age_s > 0.0 ? "old" : "in the future");
  }
  return valid_share_ < kMinValid ? "the laser's beams are invalid" : "";
}

std::vector<Eigen::Vector2d> DriveSenses::points_around(const Eigen::Vector2d& p_M,
                                                        double reach_m) const {
  std::vector<Eigen::Vector2d> points = memory_.around(p_M, reach_m);
  points.insert(points.end(), may_be_M_.begin(), may_be_M_.end());
  return points;
}

DistanceWindow DriveSenses::window(const PlanarPose& pose_M, double half_m, double max_m) const {
  const Eigen::Vector2d here = position_of(pose_M);
  return {map_, points_around(here, half_m), here, half_m, max_m};
}

/// Skips the nearest few points: of many noisy ones, they lie too near.
double DriveSenses::clear_at(const Eigen::Vector2d& p_M) const {
  constexpr std::size_t kPassedOver = 2;
  std::vector<double> distances(kPassedOver + 1, kMaxToMap);
  for (const Eigen::Vector2d& point : points_around(p_M, kMaxToMap)) {
    distances.push_back((point - p_M).norm());
  }
  std::nth_element(distances.begin(), distances.begin() + kPassedOver, distances.end());
  return std::min(distances[kPassedOver], distance_to_occupied(map_, p_M, kMaxToMap));
}

Surroundings DriveSenses::surroundings(const DistanceWindow& window, const PlanarPose& pose_M,
                                       Time now) const {
  return {&window, clear_at(position_of(pose_M)), tracker_.moving(now),
          [this](const Eigen::Vector2d& p_M) { return is_known_free(p_M); }};
}

bool DriveSenses::is_known_free(const Eigen::Vector2d& p_M) const {
  const Eigen::Vector2i cell = map_.cell_of(p_M);
  if (is_free(map_.at(cell.x(), cell.y()))) return true;
  const double reach = radius_m_ + kTrodden;
  return std::any_of(trail_M_.begin(), trail_M_.end(), [&](const Eigen::Vector2d& stood) {
    return (stood - p_M).squaredNorm() < reach * reach;
  });
}

}  // namespace tagfield
