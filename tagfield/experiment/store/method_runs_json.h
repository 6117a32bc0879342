// SPDX-License-Identifier: Apache-2.0
/// @file
/// The results of all methods for one run, as a line of JSON from which all output of a bench or a
/// sweep can be recomputed bit for bit.
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

/// Inverse. Throws Error, which begins with `location`, on text that is not such a line.
ConditionRun condition_run_in(std::string_view json, const Location& location);

}  // namespace tagfield
