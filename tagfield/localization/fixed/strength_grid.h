// SPDX-License-Identifier: Apache-2.0
/// @file
/// Places where a tag may be, with their distances from the stationary antennas that read it.
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/localization/fixed/fixed_reads.h"
#include "tagfield/localization/signal_strength/lobe.h"

namespace tagfield {

/// Squares in which a tag may be. Each tag is somewhere in one of several areas, which overlap.
struct PossiblePlaces {
  std::vector<Eigen::Vector3d> cells;  ///< Middles of the squares [m, world].
  Eigen::ArrayXd size_m;               ///< Edge of each square.
  /// Per cell (row) and area: probability density of a tag in that area [1/m²]; 0 outside it.
  Eigen::ArrayXXd density;
};

/// Known position of a tag: one cell without extent.
PossiblePlaces known_place(const Eigen::Vector3d& p_WT, Eigen::Index areas);

/// Whether there is only one, without extent.
bool is_known(const PossiblePlaces& places);

/// ln of the prior probability of each cell if the areas have these probabilities.
Eigen::ArrayXd log_prior(const PossiblePlaces& places, const Eigen::ArrayXd& areas);

/// Possible positions of a tag, and the RSSI it was read with.
struct TagOnGrid {
  PossiblePlaces places;
  std::vector<std::size_t> antennas;         ///< Indices of the antennas that read it,
  std::vector<Eigen::Vector3d> p_WA;         ///< their positions [m]
  std::vector<Eigen::Vector3d> boresight_W;  ///< and directions,
  Eigen::VectorXd rssi_dbm;                  ///< with one RSSI each.
  /// Per antenna (row) and cell: logarithm of the distance, and gain of the lobe [dB].
  Eigen::MatrixXd log_distance, gain_db;
  /// By how much these change at most from the middle of the cell to its corners.
  Eigen::MatrixXd log_change, gain_change_db;
};

/// `names`: all antennas, in the order of their indices.
TagOnGrid on_grid(const std::vector<std::string>& names, const std::vector<FixedReads>& reads,
                  PossiblePlaces places, const Lobe& lobe);

/// Replaces the places of a tag.
void put_on(PossiblePlaces places, const Lobe& lobe, TagOnGrid& tag);

/// The tag with the cells of these numbers only.
TagOnGrid with_cells(const TagOnGrid& tag, const std::vector<Eigen::Index>& numbers);

/// One tag's parts, at least one, with all their cells in that order.
TagOnGrid joined(const std::vector<TagOnGrid>& parts);

}  // namespace tagfield
