// SPDX-License-Identifier: Apache-2.0
/// @file
/// Whether results are of the same work: a hash of all that they follow from.
#pragma once

#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

/// 16 hexadecimal digits that differ, but for one chance in 2⁶⁴, where any of these does: the text
/// of a suite and `words` (what else was asked for), the scenarios of its conditions, the worlds
/// that they load, and the files that scenarios, their settings and recordings name. Throws Error
/// where a scenario or its world can't be read.
std::string work_hash(const std::string& suite_text, const Suite& suite,
                      const std::vector<std::string>& words);

/// The same of one scenario with these overrides, in the world `scene` that it loaded.
std::string work_hash(const std::string& scenario_path, const std::vector<Override>& overrides,
                      const Scene& scene, const std::vector<std::string>& words);

}  // namespace tagfield
