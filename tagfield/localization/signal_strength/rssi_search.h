// SPDX-License-Identifier: Apache-2.0
/// @file
/// Search for the positions that fit a tag's RSSI best, on the plane of its height.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/signal_strength/rssi_fit.h"

namespace tagfield {

/// A position and how well it fits.
struct RssiFit {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  double cost = 0.0;  ///< As RssiMisfit's.
};

/// A position of the search grid.
struct RssiCell {
  Eigen::Vector3d p_WT = Eigen::Vector3d::Zero();
  RssiParabola cost;
  std::vector<std::size_t> neighbours;  ///< Indices of the up to eight around it.
};

/// Cost at a cell by a law's slope, at least 0.
double cost_of(const RssiCell& cell, double slope_db);

/// A grid of 0.5 m over all positions within range of all reads. Valid for all slopes.
std::vector<RssiCell> rssi_cells(const BinnedRssi& bins, const PathLossLaw& law, double height,
                                 double max_range_m);

/// A position refined to the nearest minimum of the cost, in the plane of its height.
RssiFit rssi_refined(const BinnedRssi& bins, const PathLossLaw& law, const Eigen::Vector3d& start);

/// The best `starts` minima of the cost within range, best first, at least 0.2 m apart, from as
/// many minima of the grid, and as many of its best cells: close to a path minima are narrower than
/// cells.
std::vector<RssiFit> rssi_minima(const BinnedRssi& bins, const PathLossLaw& law,
                                 const std::vector<RssiCell>& cells, double max_range_m,
                                 std::size_t starts = 8);

}  // namespace tagfield
