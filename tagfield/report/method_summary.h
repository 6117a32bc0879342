// SPDX-License-Identifier: Apache-2.0
/// @file
/// Statistics of one method's results, for comparison with other methods.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/summary.h"

namespace tagfield {

/// Errors of the located tags [m] after the planar rigid motion that best aligns each seed's
/// estimates with the true positions; seeds with fewer than three of them have none. What remains
/// is the error of the relative positions: a global pose error shifts and rotates all tags alike.
std::vector<double> aligned_errors(const std::vector<TagOutcome>& outcomes);

/// The summary of a method. `outcomes` are of all seeds. `align`: whether aligned errors are
/// meaningful, which they are if the poses are not the true ones.
MethodSummary summary_of_method(const std::string& method, const std::vector<TagOutcome>& outcomes,
                                bool align);

}  // namespace tagfield
