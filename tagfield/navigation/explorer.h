// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where to drive next until everything that can be seen of a building has been seen.
#pragma once

#include <optional>
#include <vector>

#include "tagfield/navigation/frontiers.h"

namespace tagfield {

struct ExplorerOptions {
  FrontierOptions frontiers;
  /// When no frontier is left, shorter ones down to this length are explored: gaps between objects.
  double finest_m = 0.15;
  /// How far to turn to either side when looking at a frontier [rad], since few beams of each scan
  /// hit a wall at grazing incidence.
  double look_around_rad = 0.6;
};

/// Drives from frontier to frontier, the nearest and largest first, then to the small ones, and
/// finally back to the start.
class Explorer {
 public:
  /// `start_M` is the robot's pose, where there is no obstacle, whatever the map says.
  Explorer(const ExplorerOptions& options, const PlanarPose& start_M)
      : options_(options), start_M_(start_M) {}

  /// A copy of the drivable `map` with the unknown cells under the robot's start made free.
  [[nodiscard]] OccupancyGrid with_start(OccupancyGrid map) const;

  /// The goal to drive to from now on, or none to continue with the last one, or to stay once
  /// finished(). To be called from time to time with the current maps (see with_start() and
  /// frontiers()), and as soon as a goal `has_ended`, reached or not.
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
  std::vector<Viewpoint> looks_;   ///< Those already taken.
  std::optional<Viewpoint> look_;  ///< The one being driven to or taken.
  int turns_ = 0;                  ///< Done at the current look.
};

}  // namespace tagfield
