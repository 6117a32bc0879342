// SPDX-License-Identifier: Apache-2.0
/// @file
/// A plan as a selection problem.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "tagfield/layout/link_matrix.h"
#include "tagfield/layout/selection.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {

/// One way to mount an antenna, at the same index as in SelectionProblem::options.
struct PlanOption {
  std::size_t column = 0;  ///< Of the matrix.
  double power_dbm = 0.0;
  double less_db = 0.0;  ///< Power reduction relative to the evaluation of the matrix.
};

/// The selection problem of a plan, with the meaning of its options and zones.
struct PlanProblem {
  SelectionProblem selection;
  std::vector<PlanOption> options;
  std::vector<std::string> zones;  ///< Names, by SelectionOption::zone.
};

/// Whether it is a cross read when a reader of zone `readers` reads a tag of zone `tags`; "" is no
/// zone.
bool is_crossing(const std::string& readers, const std::string& tags);

/// The problem of a plan. Reads count with the plan's margin subtracted from their links, cross
/// reads without it.
PlanProblem problem_of(const PlanSpec& plan, const LinkMatrix& matrix);

}  // namespace tagfield
