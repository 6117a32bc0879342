// SPDX-License-Identifier: Apache-2.0
/// @file
/// People who walk about: groups of returns that are not on the map, tracked from scan to scan.
/// docs/driving.md has the equations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/navigation/scan_in_map.h"

namespace tagfield {

/// Seen from above, a disc that moves at constant velocity.
struct MovingObstacle {
  Eigen::Vector2d centre_M;
  Eigen::Vector2d velocity_M;  ///< [m/s]
  double radius_m = 0.0;

  [[nodiscard]] Eigen::Vector2d at(double seconds) const { return centre_M + seconds * velocity_M; }
};

/// A cluster of returns, represented by the disc that would look like it.
struct ReturnGroup {
  Eigen::Vector2d centre_M = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  bool is_cut = false;    ///< Only part of it is visible,
  bool is_round = false;  ///< and curved like a person's side, so that its centre is known.
  std::vector<std::size_t> returns;
};

/// The groups among the returns of `scan` that are candidates: neighbours less than 0.25 m from
/// each other, at least three of them, at most 1.2 m across. A disc of radius r at distance D
/// subtends the half angle asin(r/D), and its nearest point is D − r away. If only part is visible
/// and curved like a disc of kUsualRadius_m, it is taken for such a disc through the ends of that
/// part.
inline constexpr double kUsualRadius_m = 0.25;  ///< Of a person walking.
std::vector<ReturnGroup> groups_of(const ScanInMap& scan, const std::vector<bool>& is_candidate);

/// Tracks each group of returns with a constant-velocity Kalman filter.
class ObstacleTracker {
 public:
  /// Takes a scan; `is_candidate` says for each return whether it may belong to a moving obstacle.
  /// Returns for each return whether it does.
  std::vector<bool> update(const ScanInMap& scan, const std::vector<bool>& is_candidate);
  /// The moving obstacles, predicted to `now`. One out of sight is kept for kKeptUnseen.
  [[nodiscard]] std::vector<MovingObstacle> moving(Time now) const;
  void clear() { tracks_.clear(); }

  static constexpr double kKeptUnseen = 6.0;  ///< [s]

 private:
  struct Track {
    Eigen::Vector2d centre_M;
    Eigen::Vector2d velocity_M = Eigen::Vector2d::Zero();
    // Covariance of position and velocity along each axis.
    double var_place = 0.0;
    double covar = 0.0;
    double var_velocity = 0.0;
    double radius_m = 0.0;
    Time time;  ///< Of the state.
    Time seen;
    int updates = 0;
    int misses = 0;  ///< Consecutive scans that see through its position.
    bool is_moving = false;

    void predict(Time to);
    void correct(const ReturnGroup& group);
  };

  static Track begin(const ReturnGroup& group, Time now);
  void forget(const ScanInMap& scan);
  /// For each track the index of its group, or -1.
  [[nodiscard]] std::vector<int> assign(const std::vector<ReturnGroup>& groups) const;

  std::vector<Track> tracks_;
};

}  // namespace tagfield
