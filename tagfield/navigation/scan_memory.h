// SPDX-License-Identifier: Apache-2.0
/// @file
/// Static obstacles around the robot, as its laser saw them recently: the laser looks only ahead,
/// and the robot turns.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tagfield/navigation/scan_in_map.h"

namespace tagfield {

/// Remembers beam endpoints, one per cell of kCell, until a later scan sees through their position
/// or they expire. Points that are also on the map expire after kOnMap, others after three times
/// the time over which they were seen, within limits. So a box is still remembered when the path
/// around it leads out of sight of it, but a person who walked past is not.
class ScanMemory {
 public:
  static constexpr double kCell = 0.05;         ///< [m]
  static constexpr double kReach = 6.0;         ///< Returns farther away are ignored [m].
  static constexpr double kOnMap = 2.0;         ///< [s]
  static constexpr double kMinOffMap = 3.0;     ///< [s]
  static constexpr double kMaxOffMap = 60.0;    ///< [s]
  static constexpr double kStandsAfter = 0.5;   ///< A point seen this long is static [s].
  static constexpr double kSeenThrough = 0.06;  ///< How far past a point a beam must reach [m].

  /// Adds the returns that are not left out; drops points that the scan sees through or that have
  /// expired. `is_on_map` and `left_out` have one element per return.
  void see(const ScanInMap& scan, const std::vector<bool>& is_on_map,
           const std::vector<bool>& left_out);
  /// Forgets all points within a circle.
  void forget_around(const Eigen::Vector2d& centre_M, double radius_m);
  void clear() { points_.clear(); }

  /// All points within `reach_m` of `p_M` along each axis.
  [[nodiscard]] std::vector<Eigen::Vector2d> around(const Eigen::Vector2d& p_M,
                                                    double reach_m) const;
  /// All static points that are not on the map.
  [[nodiscard]] std::vector<Eigen::Vector2d> not_on_map() const;

 private:
  struct Point {
    Eigen::Vector2d p_M;  ///< Where it was last seen.
    Time first;
    Time last;
    bool is_on_map = false;
  };

  [[nodiscard]] static bool is_old(const Point& point, Time now);
  void drop(const ScanInMap& scan);

  std::unordered_map<std::uint64_t, Point> points_;
  std::uint64_t scans_ = 0;
};

}  // namespace tagfield
