// SPDX-License-Identifier: Apache-2.0
/// @file
/// Least squares on the phases of one tag, unwrapped or wrapped, with an offset for each span: the
/// maximum likelihood estimate for normal noise.
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/height_model.h"

namespace tagfield {

/// A position and the spans' offsets.
struct TagFit {
  PositionVector unknowns = PositionVector::Zero();
  Eigen::VectorXd offsets;  ///< By span [m].
  double cost = 0.0;        ///< Sum of the squared residuals [rad²].
};

/// Best offsets for a position: for unwrapped spans the mean of value minus range, for wrapped ones
/// the circular mean; 0 for known ones.
Eigen::VectorXd offsets_at(const TagPhases& phases, const HeightModel& height,
                           const PositionVector& unknowns);

/// Value minus range and offset [m]; wrapped phases are reduced by whole cycles to the value
/// nearest 0.
Eigen::ArrayXd residuals_of(const TagPhases& phases, const HeightModel& height, const TagFit& fit);

/// Local minimum of the cost near `start`, by the Levenberg-Marquardt method; offsets are
/// eliminated. Finite for finite input.
TagFit fit_tag(const TagPhases& phases, const HeightModel& height, const PositionVector& start);

/// Normal matrix Σ Jᵀ J, with J the derivative of the residuals in radians with respect to the
/// position's unknowns, and unknown offsets eliminated [rad²/m²]. Its third row is that of the
/// identity if the height is known.
Eigen::Matrix3d normal_of(const TagPhases& phases, const HeightModel& height,
                          const PositionVector& unknowns);

}  // namespace tagfield
