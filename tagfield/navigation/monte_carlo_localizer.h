// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where a robot is on a map, by its laser and wheels.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/hit_grid.h"
#include "tagfield/navigation/scan_matcher.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

struct LocalizerSettings {
  OdometryNoise odometry;          ///< What the wheels are believed to err.
  double update_distance_m = 0.1;  ///< A scan is used after so much driving,
  double update_turn_rad = 0.1;    ///< or turning.
  int beams = 90;                  ///< Of a scan, evenly, that weigh the particles.
  double sigma_hit_m = 0.1;        ///< Of a beam's end beside the nearest occupied cell.
  /// Power of the scan's likelihood: 1 would take all beams for independent, and lock onto wrong
  /// poses.
  double trust = 0.15;
  int least_particles = 200;
  int most_particles = 20000;
  // While it searches, particles lie thin: their weights must fall off slowly from one to the next.
  double search_sigma_m = 0.3;
  double search_trust = 0.01;
  int first_particles = 20000;  ///< Over all free space.
  int least_searching = 6000;
  double bin_m = 0.1;  ///< Of KLD sampling (Fox, 2003).
  double bin_rad = 0.087;
  double point_spacing_m = 0.05;  ///< Of the points of the final match.
  MatchOptions match;
};

enum class Localization { kSearching, kTracking };

/// What is believed of the pose.
struct PoseEstimate {
  PlanarPose pose_M;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y [m], yaw [rad].
};

/// KLD-adaptive Monte Carlo localization (Fox, 2003), finished by a match of the scan on
/// the map, which brings the pose below the particles' spread. Without a start it searches the
/// whole map's free space; when scans stop to fit for a while, as after a kidnapping, it searches
/// again. docs/localization_on_map.md has the method.
class MonteCarloLocalizer {
 public:
  /// `walls`: where in their cells the walls are, as mapping found them; null where nobody knows,
  /// so that they are taken to be in the cells' middles. Throws Error on a map without a free or
  /// without an occupied cell.
  MonteCarloLocalizer(const OccupancyGrid& map, const LocalizerSettings& settings,
                      const RigidTransform& X_RL, std::uint64_t seed,
                      const HitGrid* walls = nullptr);
  ~MonteCarloLocalizer();
  MonteCarloLocalizer(MonteCarloLocalizer&&) noexcept;
  MonteCarloLocalizer& operator=(MonteCarloLocalizer&&) noexcept;

  /// Starts at a known pose; its covariance is of x, y, yaw. Throws Error if not finite.
  void start_at(const PoseEstimate& start);
  /// Starts anywhere in the free space. Also what it begins with.
  void start_anywhere();

  /// Takes a scan whose beams are of one moment, and the odometry's pose then. Returns whether it
  /// was used, which is not done before the robot has moved on, or when no beam met anything. Takes
  /// anything: an odometry that is not finite is passed over, NaN ranges are invalid beams, and
  /// scans may differ in their beams. Knows no clock: stamps don't matter, the order of calls does.
  bool update(const LaserScan& scan, const PlanarPose& odometry);

  /// Moved on by what the odometry has told since the last scan that was used.
  [[nodiscard]] PoseEstimate estimate_at(const PlanarPose& odometry) const;
  [[nodiscard]] Localization state() const;
  /// Share of the last scan's ends that lie on the map's walls, less that of the beams that crossed
  /// one, at the estimate: 1 for a perfect map and pose.
  [[nodiscard]] double fit() const;
  [[nodiscard]] std::vector<PlanarPose> particles() const;
  /// How often it has lost its place and begun to search.
  [[nodiscard]] int times_lost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
