// SPDX-License-Identifier: Apache-2.0
/// @file
/// Localization of a robot on a map by its laser and wheel odometry.
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
  OdometryNoise odometry;          ///< Assumed error of the wheel odometry.
  double update_distance_m = 0.1;  ///< A scan is used after driving this far
  double update_turn_rad = 0.1;    ///< or turning by this much.
  int beams = 90;                  ///< Of a scan, evenly spaced, used to weight the particles.
  double sigma_hit_m = 0.1;  ///< Of a beam endpoint's distance from the nearest occupied cell.
  /// Exponent of the scan's likelihood: 1 would treat all beams as independent and lock onto wrong
  /// poses.
  double trust = 0.15;
  int min_particles = 200;
  int max_particles = 20000;
  // While it searches, particles are sparse: their weights must fall off slowly from one to the
  // next.
  double search_sigma_m = 0.3;
  double search_trust = 0.01;
  int first_particles = 20000;  ///< Over all free space.
  int min_searching = 6000;
  double bin_m = 0.1;  ///< Of KLD sampling (Fox, 2003).
  double bin_rad = 0.087;
  double point_spacing_m = 0.05;  ///< Between the points of the final match.
  MatchOptions match;
};

enum class Localization { kSearching, kTracking };

/// The estimated pose.
struct PoseEstimate {
  PlanarPose pose_M;
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< Of x, y [m], yaw [rad].
};

/// KLD-adaptive Monte Carlo localization (Fox, 2003), refined by matching the scan to the map,
/// which makes the pose more accurate than the particles' spread. Without a starting pose it
/// searches the free space of the whole map; when scans stop fitting for a while, as after a
/// kidnapping, it searches again. docs/localization_on_map.md has the method.
class MonteCarloLocalizer {
 public:
  /// `walls`: where the walls are within their cells, as found by mapping; if null, they are
  /// assumed to be at the cells' centres. Throws Error on a map without a free or without an
  /// occupied cell.
  MonteCarloLocalizer(const OccupancyGrid& map, const LocalizerSettings& settings,
                      const RigidTransform& X_RL, std::uint64_t seed,
                      const HitGrid* walls = nullptr);
  ~MonteCarloLocalizer();
  MonteCarloLocalizer(MonteCarloLocalizer&&) noexcept;
  MonteCarloLocalizer& operator=(MonteCarloLocalizer&&) noexcept;

  /// Starts at a known pose. Throws Error if not finite.
  void start_at(const PoseEstimate& start);
  /// Starts anywhere in free space. This is also the initial state.
  void start_anywhere();

  /// Takes a scan whose beams share one timestamp and the odometry pose at that time. Returns
  /// whether the scan was used: only if the robot has moved far enough since the last one and some
  /// beam hit something. Accepts any input: odometry that is not finite is ignored, NaN ranges are
  /// invalid beams, and the beams may differ from scan to scan. Uses no clock: timestamps don't
  /// matter, the order of calls does.
  bool update(const LaserScan& scan, const PlanarPose& odometry);

  /// The estimate, advanced by the odometry since the last scan used.
  [[nodiscard]] PoseEstimate estimate_at(const PlanarPose& odometry) const;
  [[nodiscard]] Localization state() const;
  /// Fraction of the last scan's endpoints that lie on the map's walls minus the fraction of its
  /// beams that crossed one, at the estimate: 1 for a perfect map and pose.
  [[nodiscard]] double fit() const;
  [[nodiscard]] std::vector<PlanarPose> particles() const;
  /// How often it has got lost and begun to search.
  [[nodiscard]] int times_lost() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace tagfield
