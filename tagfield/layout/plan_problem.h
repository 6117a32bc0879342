// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a plan asks, as a problem of selection.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/layout/link_matrix.h"
#include "tagfield/layout/selection.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// A way to mount one antenna, as SelectionProblem::options numbers it.
struct PlanOption {
  std::size_t column = 0;  ///< Of the matrix.
  double power_dbm = 0.0;
  double less_db = 0.0;  ///< Than what the matrix was evaluated with.
};

/// A plan as a problem of selection.
struct PlanProblem {
  SelectionProblem selection;
  std::vector<PlanOption> options;
  std::vector<std::string> zones;  ///< Names, by SelectionOption::zone.
};

/// Whether a reader for the zone `readers` that reads a tag of the zone `tags` crosses; "" is no
/// zone.
bool is_crossing(const std::string& readers, const std::string& tags);

/// Reads count with the plan's margin taken off their links, cross reads with links as they are.
PlanProblem problem_of(const PlanSpec& plan, const LinkMatrix& matrix);

}  // namespace tagfield
