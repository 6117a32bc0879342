// SPDX-License-Identifier: Apache-2.0
/// @file
/// Conversion of one tag's fits to candidates: the uncertainty of each, and which can't be
/// distinguished.
#pragma once

#include <Eigen/Core>
#include <vector>

#include "tagfield/localization/tag_estimate.h"
#include "tagfield/localization/tag_fit.h"

namespace tagfield {

/// Covariance of the unknowns of a fit [m², q in m⁴]: σ² τ N⁻¹, with the residuals' variance σ² and
/// their correlation factor τ (residuals.h). Rows of a known height are 0. Singular geometry gives
/// variances of 1e12.
Eigen::Matrix3d covariance_of(const TagPhases& phases, const HeightModel& height,
                              const TagFit& fit);

/// Covariance of the unknowns that includes the pose error, if the phases have a model of that:
/// N⁻¹(σφ²N + S)N⁻¹, with the phase noise σφ from differences of neighbouring residuals (from all
/// residuals if none are neighbours), and S the covariance that the Ornstein-Uhlenbeck error of the
/// antenna's position adds to the right-hand side of the normal equations. Otherwise
/// covariance_of() times the square of fitted_away().
Eigen::Matrix3d honest_covariance(const TagPhases& phases, const HeightModel& height,
                                  const TagFit& fit);

/// Absolute differences [rad] between the residuals [m] of neighbouring reads, less than 0.35 s
/// apart; slow errors hardly affect them.
std::vector<double> neighbour_differences(const TagPhases& phases, const Eigen::ArrayXd& errors);

/// Phase noise [rad] from the median of such differences, which must not be empty: for normal noise
/// their median is 0.6745 √2 σ.
double noise_of_differences(std::vector<double> differences);

/// A candidate at `unknowns` with their covariance and the misfit `rms_m`.
Candidate make_candidate(const HeightModel& height, const PositionVector& unknowns,
                         const Eigen::Matrix3d& covariance, double rms_m);

/// A candidate of a fit, with its honest_covariance().
Candidate make_candidate(const TagPhases& phases, const HeightModel& height, const TagFit& fit);

/// The best fit and those that the data can't distinguish from it (tells_apart()), best first.
/// `fits` must not be empty.
std::vector<Candidate> make_candidates(const TagPhases& phases, const HeightModel& height,
                                       std::vector<TagFit> fits);

/// Starting points along the direction in which `fit` is least certain, up to three standard
/// deviations away and so closely spaced that ranges change by at most an eighth of a wavelength
/// between them, so that the local minima of the wrapped misfit lie among them. The fit itself
/// comes first; at most 81.
std::vector<PositionVector> spread_starts(const TagPhases& phases, const HeightModel& height,
                                          const TagFit& fit, const Eigen::Matrix3d& covariance);

}  // namespace tagfield
