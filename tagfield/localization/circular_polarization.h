// SPDX-License-Identifier: Apache-2.0
/// @file
/// Phase rotation between a circularly polarized antenna and a linearly polarized tag (one wire):
/// it depends on the direction to the tag and on the direction of its wire, which is unknown.
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>
#include <string>

#include "tagfield/localization/method.h"

namespace tagfield {

/// Phase rotation of a reply [rad, mod 2π]: −2 arg(E·e) for an antenna of orientation `R_WA` with
/// crossed wires along its y and z axes (docs/antennas.md) and a tag in the direction `way_W` with
/// its wire along `axis_W`. Both vectors may have any length above 0.
double polarization_turn(Hand hand, const Eigen::Matrix3d& R_WA, const Eigen::Vector3d& way_W,
                         const Eigen::Vector3d& axis_W);

/// Effect of a tag's wire on its phases, as far as it can be estimated from them.
struct PolarizationAllowance {
  /// With the phase rotations removed, where they are known.
  std::optional<SamplesOfTag> samples{};
  /// Additional covariance of the position [m²], from the uncertainty of the wire's direction and
  /// from other directions that fit nearly as well. Vertical entries are 0 if the height is known.
  Eigen::Matrix3d added = Eigen::Matrix3d::Zero();
};

/// Allowances by tag.
using PolarizationAllowances = std::map<std::string, PolarizationAllowance>;

/// For each tag with a position in `result`, fits the wire's direction together with a position
/// nearby and an offset for each antenna and channel, by least squares started from directions all
/// around. Skips tags for which two positions fit, antennas that are not in `problem.circular`, and
/// antennas without orientations (all rotations are the identity).
PolarizationAllowances allow_for_polarization(const LocalizationProblem& problem,
                                              const LocalizationResult& result, int threads);

/// Adds the covariances from allow_for_polarization() to those of the result and updates the
/// verdicts.
void add_polarization_error(const PolarizationAllowances& allowances, const EstimateLimits& limits,
                            LocalizationResult& result);

}  // namespace tagfield
