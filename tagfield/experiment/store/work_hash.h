// SPDX-License-Identifier: Apache-2.0
/// @file
/// A hash of everything that results depend on, to tell whether they are of the same work.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

/// 16 hexadecimal digits that differ, except with a probability of 2⁻⁶⁴, if any of these differs:
/// the text of a suite and `words` (other options of the request), the scenarios of its conditions,
/// the worlds that they load, and the files named by scenarios, their settings and recordings.
/// Throws Error if a scenario or its world can't be read.
std::string work_hash(const std::string& suite_text, const Suite& suite,
                      const std::vector<std::string>& words);

/// Same, but for one scenario with these overrides, in the world `scene` that it loaded.
std::string work_hash(const std::string& scenario_path, const std::vector<Override>& overrides,
                      const Scene& scene, const std::vector<std::string>& words);

}  // namespace tagfield
