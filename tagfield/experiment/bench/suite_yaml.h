// SPDX-License-Identifier: Apache-2.0
/// @file
/// Suites from YAML files. docs/bench.md lists every key.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"

namespace tagfield {

/// Reads a suite. Paths of scenarios are relative to the file. Throws Error "FILE:LINE: …".
Suite load_suite(const std::string& path);

/// The same of a text, which was read from the file `path` here or elsewhere: whether scenarios are
/// there is not asked.
Suite suite_from_text(const std::string& text, const std::string& path);

/// Only the methods and conditions of these names, in the suite's order; all where a list is empty.
/// Conditions that none of the methods is left for go too. Throws Error on a name that there is
/// not, with the nearest, and where nothing is left.
Suite only(const Suite& suite, const std::vector<std::string>& methods,
           const std::vector<std::string>& conditions);

/// Whether the method runs in this condition.
bool runs_in(const SuiteMethod& method, const Condition& condition);

}  // namespace tagfield
