// SPDX-License-Identifier: Apache-2.0
/// @file
/// Stationary antennas and the tags that they read, with everything learned from RSSI and phases of
/// all tags.
#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

#include "tagfield/localization/fixed/channel_offsets.h"
#include "tagfield/localization/fixed/fixed.h"
#include "tagfield/localization/fixed/place_posterior.h"
#include "tagfield/localization/fixed/strength_law.h"

namespace tagfield {

/// A tag and everything known about it.
struct FixedTag {
  const std::string* name = nullptr;
  const SamplesOfTag* samples = nullptr;
  std::vector<FixedReads> reads;
  TagOnGrid grid;
  double cell_m = 0.0;
  Eigen::ArrayXd areas_m2;  ///< How much of each area the tag may be in [m²].
  double spread_m = 0.0;    ///< Of its places before RSSI and phases.
  std::string why_not;
};

struct FixedScene {
  std::vector<std::string> antennas;
  std::vector<FixedTag> tags;
  std::vector<Eigen::AlignedBox2d> areas;  ///< Each in the one before it.
  LearnedLaw law;
  ChannelTurns offsets;
  PhaseField field;
  double trust = 1.0;         ///< Exponent of the phase likelihoods.
  std::string swapped;        ///< The two antennas that appear to be swapped, or "".
  bool out_of_order = false;  ///< The phases contradict the given carriers and are not used.
};

/// Per place (row) and area: probability density [1/m²] of a tag in the area, of which it may be in
/// `areas_m2`. An area in which it cannot be counts as the one around it.
Eigen::ArrayXXd densities_in(const std::vector<Eigen::AlignedBox2d>& areas,
                             const Eigen::ArrayXd& areas_m2,
                             const std::vector<Eigen::Vector3d>& places);

/// Learns the path-loss law, the channel offsets and the phase field from all tags.
FixedScene fixed_scene(const LocalizationProblem& problem, int threads,
                       const FixedOptions& options);

}  // namespace tagfield
