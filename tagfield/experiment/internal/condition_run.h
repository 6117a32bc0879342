// SPDX-License-Identifier: Apache-2.0
/// @file
/// One condition with one seed: simulated once, localized by every method, judged.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/prepared.h"
#include "tagfield/simulator/simulation.h"

namespace tagfield {

/// A MethodRun for each method of the condition, in their order; none if `control.stop` was set
/// before all were done.
std::optional<std::vector<MethodRun>> run_condition(const PreparedCondition& condition,
                                                    std::uint64_t seed, const RunControl& control,
                                                    Diagnostics& diagnostics);

}  // namespace tagfield
