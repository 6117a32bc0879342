// SPDX-License-Identifier: Apache-2.0
/// @file
/// What one method makes of the reads, in numbers, to be compared with others'.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/summary.h"

namespace tagfield {

/// Errors of the located tags [m] after the shift and turn of the plane that brings each seed's
/// estimates closest to the true places; seeds with fewer than three of them have none. What is
/// left is the shape's error: a pose that is off as a whole shifts and turns all tags alike.
std::vector<double> aligned_errors(const std::vector<TagOutcome>& outcomes);

/// `outcomes` are of all seeds. `align` tells whether aligned errors mean anything, as they do
/// where the pose is but believed.
MethodSummary summary_of_method(const std::string& method, const std::vector<TagOutcome>& outcomes,
                                bool align);

}  // namespace tagfield
