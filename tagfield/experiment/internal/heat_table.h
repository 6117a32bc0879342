// SPDX-License-Identifier: Apache-2.0
/// @file
/// The comparison at a glance: conditions by methods, and the winners.
#pragma once

#include <string>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// One row per condition, one column per method, coloured by the mean error, with the winner of
/// each condition; and the accompanying text. HTML.
std::string heat_table(const Bench& bench);

/// "ml, 3.1 mm; not significantly different from it: joint, auto" as plain text; "none: …" if no
/// tag was located correctly.
std::string winner_words(const Bench& bench, const BenchCondition& condition);

}  // namespace tagfield
