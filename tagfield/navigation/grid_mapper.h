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

/// While the map grows some cells have been seen by many scans, and others by one: they are to
/// weigh alike in a surface.
inline MatchOptions growing_map() {
  MatchOptions options;
  options.most_ends = 20.0;
  return options;
}

struct MapperSettings {
  double resolution_m = 0.05;
  int particles = 10;
  OdometryNoise odometry;           ///< What the wheels are believed to err.
  double update_distance_m = 0.15;  ///< A scan is entered after so much driving,
  double update_turn_rad = 0.1;     ///< or turning.
  int first_scans = 15;             ///< Entered before it moves, so that the map begins sharp.
  double most_clear_m = 15.0;       ///< How far a beam that met nothing clears the map.
  double point_spacing_m = 0.06;    ///< Of the points that are matched.
  MatchOptions match = growing_map();
  int threads = 1;  ///< The map does not depend on it.
};

/// A Rao-Blackwellized particle filter (Grisetti, Stachniss, Burgard, 2007): each particle has a
/// path and the map that follows from it. A particle's next pose is drawn from the Gaussian that
/// the scan's match on its own map and the odometry give together, and its weight grows by the
/// evidence of both; particles are resampled when few carry the weight. docs/mapping.md has the
/// equations. Frame M, the map's, is set by the starting pose.
class GridMapper {
 public:
  GridMapper(const MapperSettings& settings, const RigidTransform& X_RL, const PlanarPose& start_M,
             std::uint64_t seed);

  /// Takes a scan whose beams are of one moment (deskewed() makes it so), and the odometry's pose
  /// then. Returns whether it was entered, which is not done before the robot has moved on. Scans
  /// without any return, or with an odometry that is not finite, are passed over.
  bool update(const LaserScan& scan, const PlanarPose& odometry);

  /// Goes over the whole drive once more: leaves the best particle alone, and fits each of its
  /// scans anew to the map that all of them make, `sweeps` times. Early scans then profit from late
  /// ones, which a filter's don't. The scans made at the start stay where they are in the mean. To
  /// be done when the drive is over; it can go on afterwards.
  void polish(int sweeps = 4);

  /// Covariance of x, y, yaw of the start on the map as it is now [m², m·rad, rad²]: of the match
  /// of the first scan, which is by how much the map may be off as a whole. Zero before the first
  /// scan.
  [[nodiscard]] Eigen::Matrix3d start_covariance() const;

  /// Of the best particle, moved on by what the odometry has told since its last scan.
  [[nodiscard]] PlanarPose pose_at(const PlanarPose& odometry) const;
  /// Of the best particle.
  [[nodiscard]] OccupancyGrid map() const;
  [[nodiscard]] const HitGrid& hits() const;
  /// Number of particles that carry the weight: 1/Σw².
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
  std::vector<ScanPoints> scans_;  ///< All that were entered.
  PlanarPose odometry_;            ///< At the last entered scan.
  std::uint64_t updates_ = 0;
  std::size_t start_scans_ = 0;  ///< Those entered before it first moved.
  bool still_at_start_ = true;
};

}  // namespace tagfield
