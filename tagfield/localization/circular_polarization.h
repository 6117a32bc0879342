// SPDX-License-Identifier: Apache-2.0
/// @file
/// What the phase of a circularly polarized antenna adds on the way to a tag with one wire: it
/// turns with the direction in which the tag is seen, by where the wire points, which nobody knows.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "tagfield/localization/method.h"

namespace tagfield {

/// By how much the phase of a reply turns [rad, mod 2π]: −2 arg(E·e) of an antenna with crossed
/// wires along its y and z axes (docs/antennas.md), looking as `R_WA` says, with the tag's wire
/// along `axis_W`, seen in the direction `way_W`. Both of any length above 0.
double polarization_turn(Hand hand, const Eigen::Matrix3d& R_WA, const Eigen::Vector3d& way_W,
                         const Eigen::Vector3d& axis_W);

/// What a tag's wire does to its phases, as far as those tell it.
struct PolarizationAllowance {
  std::optional<SamplesOfTag> samples{};  ///< Without the turns, where they are known.
  /// What the place is worse known for it, and what other directions of the wire that fit nearly as
  /// well make of it: covariance in x and y [m²].
  Eigen::Matrix2d added = Eigen::Matrix2d::Zero();
};

/// By tag.
using PolarizationAllowances = std::map<std::string, PolarizationAllowance>;

/// For each tag of which `result` has a place, the wire's direction is fitted with the place near
/// it and an offset for each antenna and channel, by least squares from directions all around.
/// Nothing of tags for which two places fit, of antennas that are not in `problem.circular`, and of
/// those whose orientation is not told (all poses are the identity).
PolarizationAllowances allow_for_polarization(const LocalizationProblem& problem,
                                              const LocalizationResult& result, int threads);

/// Adds what allow_for_polarization() says to the result's covariances and judges anew.
void add_polarization_error(const PolarizationAllowances& allowances, const EstimateLimits& limits,
                            LocalizationResult& result);

}  // namespace tagfield
