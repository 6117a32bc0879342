// SPDX-License-Identifier: Apache-2.0
/// @file
/// Likelihood of a tag's places by its RSSI under a law of distance.
#pragma once

#include <Eigen/Core>

#include "tagfield/localization/fixed/strength_law.h"

namespace tagfield {

/// Antennas' part of a tag's rows of the linear law: RSSI − gains = [levels, −log₁₀ r] θ.
/// `columns`: level and deviations.
Eigen::MatrixXd levels_of(const TagOnGrid& tag, Eigen::Index columns);

/// ln p(RSSI | cell), all constants included.
struct CellStrengths {
  Eigen::ArrayXd middle;  ///< At the middle of each cell.
  Eigen::ArrayXd bound;   ///< Upper bound of it within each cell.
};

CellStrengths cell_strengths(const TagOnGrid& tag, const StrengthLaw& law,
                             const StrengthPrior& prior);

/// ln p(RSSI | middle of the cell) alone.
Eigen::ArrayXd log_strength(const TagOnGrid& tag, const StrengthLaw& law,
                            const StrengthPrior& prior);

/// The tag on cells so small that the law's RSSI hardly changes within them, compared with its
/// fading. Cells that hold no share of the posterior are left out.
TagOnGrid refined(const TagOnGrid& tag, const StrengthLaw& law, const StrengthPrior& prior);

}  // namespace tagfield
