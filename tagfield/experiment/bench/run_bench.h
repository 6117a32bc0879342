// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: runs methods in conditions with seeds, in parallel.
#pragma once

#include "tagfield/experiment/bench/bench.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/simulator/run_control.h"

namespace tagfield {

struct PreparedSuite;  // of prepared.h
class RunStore;        // of store/run_store.h

/// Each condition with each seed is simulated once, and all its methods get the same problem. The
/// result does not depend on the number of threads, times excepted. Runs that were not over when
/// `control.stop` was set are left out. Warnings are those of each condition's first seed. What
/// runs come to goes into `store`, where given, or is taken from there (its keys: place of the
/// condition in the suite, seed).
Bench run_bench(const PreparedSuite& prepared, const RunControl& control,
                RunStore* store = nullptr);

/// Reads scenarios, then runs. Throws Error as prepare() does, and on a recording that is there.
Bench run_bench(const Suite& suite, const std::vector<Method>& methods, const RunControl& control);

}  // namespace tagfield
