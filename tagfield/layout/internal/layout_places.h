// SPDX-License-Identifier: Apache-2.0
/// @file
/// How well a layout meets the aim at each tag position: the positions of all groups, one group
/// after the other.
#pragma once

#include <vector>

#include "tagfield/layout/plan_problem.h"

namespace tagfield {

/// met_by(), averaged over the orientations and fading of each position.
std::vector<double> met_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                 const PlanProblem& problem, const OptionSet& choice);

/// For Worth::kPlace, bounds on the error of each position [m], from the mean information over its
/// orientations and fading.
std::vector<double> errors_by_place(const PlanSpec& plan, const LinkMatrix& matrix,
                                    const PlanProblem& problem, const OptionSet& choice);

}  // namespace tagfield
