// SPDX-License-Identifier: Apache-2.0
/// @file
/// The comparison at a glance: conditions by methods, and who wins.
#pragma once

#include <string>

#include "tagfield/experiment/bench/bench.h"

namespace tagfield {

/// A row a condition, a column a method, coloured by the mean error, with the winner of each
/// condition; and the words that go with it. HTML.
std::string heat_table(const Bench& bench);

/// "ml, 3.1 mm; not significantly different from it: joint, auto" as plain text; "none: …" where no
/// tag was located right.
std::string winner_words(const Bench& bench, const BenchCondition& condition);

}  // namespace tagfield
