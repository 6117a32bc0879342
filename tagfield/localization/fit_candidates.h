// SPDX-License-Identifier: Apache-2.0
/// @file
/// From fits of one tag to candidates: how uncertain each is, and which can't be told apart.
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

/// Covariance of the unknowns with the pose error's model, where the phases tell it: N⁻¹ (σφ² N +
/// S) N⁻¹, with the phase noise σφ from neighbouring residuals, or all of them where none are
/// neighbours, and S what the Ornstein-Uhlenbeck error of the antenna's places adds to the normal
/// equations' right side. Else covariance_of().
Eigen::Matrix3d honest_covariance(const TagPhases& phases, const HeightModel& height,
                                  const TagFit& fit);

/// Magnitudes of the differences [rad] between residuals [m] of neighbouring reads, less than 0.35
/// s apart, which slow errors leave alone.
std::vector<double> neighbour_differences(const TagPhases& phases, const Eigen::ArrayXd& errors);

/// Phase noise [rad] by the median of such differences, which must not be empty: of normal noise
/// the median magnitude is 0.6745 √2 σ.
double noise_of_differences(std::vector<double> differences);

/// A candidate at `unknowns` with their covariance and the misfit `rms_m`.
Candidate make_candidate(const HeightModel& height, const PlaceVector& unknowns,
                         const Eigen::Matrix3d& covariance, double rms_m);

/// A candidate of a fit, with its honest_covariance().
Candidate make_candidate(const TagPhases& phases, const HeightModel& height, const TagFit& fit);

/// The best fit and those that the data can't tell from it (tells_apart()), best first. `fits` must
/// not be empty.
std::vector<Candidate> make_candidates(const TagPhases& phases, const HeightModel& height,
                                       std::vector<TagFit> fits);

/// Places along the direction in which `fit` is least certain, three deviations far and so close
/// together that ranges change by at most an eighth of a wavelength between them: the minima of a
/// misfit known but for whole cycles lie among them. The fit's own place comes first; at most 81.
std::vector<PlaceVector> spread_starts(const TagPhases& phases, const HeightModel& height,
                                       const TagFit& fit, const Eigen::Matrix3d& covariance);

}  // namespace tagfield
