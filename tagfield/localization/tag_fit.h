// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on the phases of one tag, unwrapped or wrapped, with an offset for each span: with
/// normal noise the maximum of the likelihood.
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/height_model.h"

namespace tagfield {

/// A place and the spans' offsets.
struct TagFit {
  PlaceVector unknowns = PlaceVector::Zero();
  Eigen::VectorXd offsets;  ///< By span [m].
  double cost = 0.0;        ///< Σ of the squared residuals [rad²].
};

/// Offsets that suit a place: of unwrapped spans the mean of value less range, of wrapped ones the
/// circular mean; 0 of known ones.
Eigen::VectorXd offsets_at(const TagPhases& phases, const HeightModel& height,
                           const PlaceVector& unknowns);

/// Value less range and offset [m], by whole cycles nearest to 0.
Eigen::ArrayXd residuals_of(const TagPhases& phases, const HeightModel& height, const TagFit& fit);

/// The local minimum of the cost near `start`, by Gauss and Newton's method with Levenberg's
/// damping; offsets are eliminated. Finite for finite input.
TagFit fit_tag(const TagPhases& phases, const HeightModel& height, const PlaceVector& start);

/// Σ Jᵀ J of the residuals in radians by the place's unknowns, unknown offsets eliminated
/// [rad²/m²]. Its third row is that of the identity where the height is known.
Eigen::Matrix3d normal_of(const TagPhases& phases, const HeightModel& height,
                          const PlaceVector& unknowns);

}  // namespace tagfield
