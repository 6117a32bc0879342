// SPDX-License-Identifier: Apache-2.0
/// @file
/// What all methods made of one run, as a line of JSON, from which all that a bench or a sweep says
/// can be computed again to the last bit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// One condition with one seed.
struct ConditionRun {
  std::vector<MethodRun> methods;  ///< In the suite's order.
  std::vector<std::string> warnings;
};

std::string to_json_line(const ConditionRun& run);

/// Inverse. Throws Error, which begins with `location`, on text that is no such line.
ConditionRun condition_run_in(std::string_view json, const Location& location);

}  // namespace tagfield
