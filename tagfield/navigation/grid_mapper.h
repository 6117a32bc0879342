// SPDX-License-Identifier: Apache-2.0
/// @file
/// Simultaneous localization and mapping with a laser and wheel odometry.
#pragma once

#include <cstdint>
#include <vector>

#include "tagfield/laser/laser_scan.h"
#include "tagfield/map/occupancy_grid.h"
#include "tagfield/motion/odometry_noise.h"
#include "tagfield/motion/unicycle.h"
#include "tagfield/navigation/hit_grid.h"
#include "tagfield/navigation/scan_matcher.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield {

/// While the map grows, some cells have been seen by many scans and others by only one: they should
/// weigh alike in a surface.
inline MatchOptions growing_map() {
  MatchOptions options;
  options.max_ends = 20.0;
  return options;
}

struct MapperSettings {
  double resolution_m = 0.05;
  int particles = 10;
  OdometryNoise odometry;           ///< Assumed error of the wheel odometry.
  double update_distance_m = 0.15;  ///< A scan is entered after driving this far
  double update_turn_rad = 0.1;     ///< or turning by this much.
  int first_scans = 15;       ///< Entered before the robot moves, so that the map starts out sharp.
  double max_clear_m = 15.0;  ///< How far a beam without a hit clears the map.
  double point_spacing_m = 0.06;  ///< Between the points to match.
  MatchOptions match = growing_map();
  int threads = 1;  ///< The map does not depend on it.
};

/// A Rao-Blackwellized particle filter (Grisetti, Stachniss, Burgard, 2007): each particle has a
/// trajectory and the map that follows from it. A particle's next pose is drawn from the Gaussian
/// that combines the scan match on its own map with the odometry, and its weight is multiplied by
/// their joint evidence. Particles are resampled when few of them carry the weight. docs/mapping.md
/// has the equations. The map frame M is set by the starting pose.
class GridMapper {
 public:
  GridMapper(const MapperSettings& settings, const RigidTransform& X_RL, const PlanarPose& start_M,
             std::uint64_t seed);

  /// Takes a scan whose beams share one timestamp (see deskewed()) and the odometry pose at that
  /// time. Returns whether the scan was entered into the map: after the first few, only if the
  /// robot has moved far enough since the last one. Ignores scans without any return or with
  /// odometry that is not finite.
  bool update(const LaserScan& scan, const PlanarPose& odometry);

  /// Refines the whole trajectory: keeps only the best particle and refits each of its scans to the
  /// map made of all of them, `sweeps` times. Early scans then benefit from later ones, which a
  /// filter does not offer. The mean pose of the scans at the start stays fixed. To be called at
  /// the end of a drive, which may continue afterwards.
  void polish(int sweeps = 4);

  /// Covariance of x, y, yaw of the start on the current map [m², m·rad, rad²], from matching the
  /// first scan: by how much the map as a whole may be off. Zero before the first scan.
  [[nodiscard]] Eigen::Matrix3d start_covariance() const;

  /// Pose of the best particle, advanced by the odometry since its last scan.
  [[nodiscard]] PlanarPose pose_at(const PlanarPose& odometry) const;
  /// Map of the best particle.
  [[nodiscard]] OccupancyGrid map() const;
  [[nodiscard]] const HitGrid& hits() const;
  /// Effective number of particles: 1/Σw².
  [[nodiscard]] double effective_particles() const;
  [[nodiscard]] std::uint64_t updates() const { return updates_; }

 private:
  struct Particle {
    PlanarPose pose_M;
    HitGrid map;
    std::vector<PlanarPose> path_M;  ///< At each entered scan.
    double log_weight = 0.0;
    double score = 0.0;  ///< Sum of the log weights of its whole ancestry.
  };

  [[nodiscard]] bool has_moved(const PlanarPose& increment) const;
  void advance(Particle& particle, std::size_t index, const PlanarPose& increment,
               const std::vector<Eigen::Vector2d>& points, const ScanPoints& scan) const;
  void normalize_weights();
  void resample();
  [[nodiscard]] const Particle& best() const;

  MapperSettings settings_;
  RigidTransform X_RL_;
  std::uint64_t seed_;
  std::vector<Particle> particles_;
  std::vector<ScanPoints> scans_;  ///< All scans entered.
  PlanarPose odometry_;            ///< At the last entered scan.
  std::uint64_t updates_ = 0;
  std::size_t start_scans_ = 0;  ///< Scans entered before the robot first moved.
  bool still_at_start_ = true;
};

}  // namespace tagfield
