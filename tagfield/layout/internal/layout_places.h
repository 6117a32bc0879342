// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a layout has at each place of tags: all groups' places, one group after the other.
#pragma once

#include <vector>

#include "tagfield/layout/plan_problem.h"

namespace tagfield {

/// met_by() in the mean over the orientations and fading of each place.
std::vector<double> met_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                 const PlanProblem& problem, const OptionSet& choice);

/// Where places count, bounds on the error of each [m], by what is told in the mean over its
/// orientations and fading.
std::vector<double> errors_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                    const PlanProblem& problem, const OptionSet& choice);

}  // namespace tagfield
