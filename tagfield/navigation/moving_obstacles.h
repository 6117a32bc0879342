// SPDX-License-Identifier: Apache-2.0
/// @file
/// Who walks about: groups of returns that are not on the map, followed from scan to scan.
/// docs/driving.md has the equations.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/base/time.h"
#include "tagfield/navigation/scan_in_map.h"

namespace tagfield {

/// Seen from above, a disc that moves on as it did last.
struct MovingObstacle {
  Eigen::Vector2d centre_M;
  Eigen::Vector2d velocity_M;  ///< [m/s]
  double radius_m = 0.0;

  [[nodiscard]] Eigen::Vector2d at(double seconds) const { return centre_M + seconds * velocity_M; }
};

/// A group of returns that lie together, as the disc that would look like it.
struct ReturnGroup {
  Eigen::Vector2d centre_M = Eigen::Vector2d::Zero();
  double radius_m = 0.0;
  bool is_cut = false;    ///< Only part of it can be seen,
  bool is_round = false;  ///< and that is bent as somebody's side is, so that its middle is known.
  std::vector<std::size_t> returns;
};

/// The groups among the returns of `scan` for which `is_candidate`: neighbours less than 0.25 m
/// from each other, at least three of them, at most 1.2 m across. A disc of radius r at distance D
/// takes the half angle asin(r/D), and its nearest point is D − r away. Where only part can be seen
/// and is bent like a disc of kUsualRadius_m, it is taken for one through that part's ends.
inline constexpr double kUsualRadius_m = 0.25;  ///< Of somebody who walks.
std::vector<ReturnGroup> groups_of(const ScanInMap& scan, const std::vector<bool>& is_candidate);

/// Follows groups of returns by a Kalman filter of constant velocity each.
class ObstacleTracker {
 public:
  /// Takes a scan; `is_candidate` says for each return whether it may belong to who moves. Returns
  /// for each whether it does.
  std::vector<bool> update(const ScanInMap& scan, const std::vector<bool>& is_candidate);
  /// Those who move, where they are at `now`: an unseen one is kept for kKeptUnseen.
  [[nodiscard]] std::vector<MovingObstacle> moving(Time now) const;
  void clear() { tracks_.clear(); }

  static constexpr double kKeptUnseen = 6.0;  ///< [s]

 private:
  struct Track {
    Eigen::Vector2d centre_M;
    Eigen::Vector2d velocity_M = Eigen::Vector2d::Zero();
    // Covariance of place and velocity along each axis.
    double var_place = 0.0;
    double covar = 0.0;
    double var_velocity = 0.0;
    double radius_m = 0.0;
    Time time;  ///< Of the state.
    Time seen;
    int updates = 0;
    int misses = 0;  ///< Scans in a row that see through its place.
    bool is_moving = false;

    void predict(Time to);
    void correct(const ReturnGroup& group);
  };

  static Track begin(const ReturnGroup& group, Time now);
  void forget(const ScanInMap& scan);
  /// For each track its group's number, or -1.
  [[nodiscard]] std::vector<int> assign(const std::vector<ReturnGroup>& groups) const;

  std::vector<Track> tracks_;
};

}  // namespace tagfield
