// SPDX-License-Identifier: Apache-2.0
/// @file
/// What stands around the robot, as its laser saw it in the last while: the laser looks ahead only,
/// and the robot turns.
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <unordered_map>
#include <vector>

#include "tagfield/navigation/scan_in_map.h"

namespace tagfield {

/// Remembers the points where beams ended, one for each cell of kCell, until a later scan sees
/// through their place, or until they are old. What is on the map besides is forgotten after
/// kOnMap; what isn't after three times as long as it was seen to stand there, within limits, so
/// that a box is still there when the way round it leads out of its sight, and who walked past is
/// not.
class ScanMemory {
 public:
  static constexpr double kCell = 0.05;        ///< [m]
  static constexpr double kReach = 6.0;        ///< Returns farther away are not taken [m].
  static constexpr double kOnMap = 2.0;        ///< [s]
  static constexpr double kLeastOffMap = 3.0;  ///< [s]
  static constexpr double kMostOffMap = 60.0;  ///< [s]
  static constexpr double kStandsAfter =
      0.5;  ///< Seen over so long, a point belongs to what stands [s].
  static constexpr double kSeenThrough = 0.06;  ///< How far beyond a point a beam must go [m].

  /// Takes the returns that are not left out, drops what the scan sees through and what is old.
  /// `is_on_map` and `left_out` have one for each return.
  void see(const ScanInMap& scan, const std::vector<bool>& is_on_map,
           const std::vector<bool>& left_out);
  /// Forgets what lies within a circle.
  void forget_around(const Eigen::Vector2d& centre_M, double radius_m);
  void clear() { points_.clear(); }

  /// All points whose coordinates are each within `reach_m` of `p_M`'s.
  [[nodiscard]] std::vector<Eigen::Vector2d> around(const Eigen::Vector2d& p_M,
                                                    double reach_m) const;
  /// All points of what stands and is not on the map.
  [[nodiscard]] std::vector<Eigen::Vector2d> not_on_map() const;

 private:
  struct Point {
    Eigen::Vector2d p_M;  ///< Where it was seen last.
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
