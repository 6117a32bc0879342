// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which places to drive to until all that can be seen of a building is seen.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/navigation/frontiers.h"

namespace tagfield {

struct ExplorerOptions {
  FrontierOptions frontiers;
  /// When no frontier is left, those down to this length are looked into: gaps between things.
  double finest_m = 0.15;
  /// A place is looked at so far to either side, since a wall seen at a slant is met by few beams
  /// of each scan [rad].
  double look_around_rad = 0.6;
};

/// Drives from frontier to frontier, the nearest and largest first, then to the small ones, and at
/// last back to the start.
class Explorer {
 public:
  /// `start_M` is where the robot stands, with nothing in its way there, whatever the map says.
  Explorer(const ExplorerOptions& options, const PlanarPose& start_M)
      : options_(options), start_M_(start_M) {}

  /// `map` as the robot may drive on it, with the ground that it started on made free where
  /// unknown.
  [[nodiscard]] OccupancyGrid with_start(OccupancyGrid map) const;

  /// The goal to drive to from now on, or none: go on with the last one, or stay once finished().
  /// To be asked now and then, with the map as it is (see with_start() and frontiers()), and as
  /// soon as a goal `has_ended`, reached or not.
  std::optional<PlanarPose> next(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                 const PlanarPose& pose_M, bool has_ended);
  [[nodiscard]] bool is_going_home() const { return stage_ >= Stage::kGoingHome; }
  [[nodiscard]] bool finished() const { return stage_ == Stage::kFinished; }

 private:
  enum class Stage { kFrontiers, kGaps, kGoingHome, kFinished };

  [[nodiscard]] bool is_open(const std::vector<Frontier>& open) const;
  std::vector<Frontier> open_ones(const OccupancyGrid& map, const OccupancyGrid& drivable,
                                  const PlanarPose& pose_M);

  ExplorerOptions options_;
  PlanarPose start_M_;
  Stage stage_ = Stage::kFrontiers;
  std::vector<Viewpoint> looks_;   ///< That were taken.
  std::optional<Viewpoint> look_;  ///< On the way to it, or there.
  int turns_ = 0;                  ///< Taken at the present look.
};

}  // namespace tagfield
