// SPDX-License-Identifier: Apache-2.0
/// @file
/// The door of this room: reads and antenna poses in, an estimate for each tag out, by any method.
/// Knows nothing of where the tags really are.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// All methods that come with Tagfield, in the order in which people are told of them.
std::vector<Method> built_in_methods();

/// Whether a method goes by phases, so that without them it locates nothing: of those that come
/// with Tagfield; false of one's own.
bool is_by_phase(const std::string& method);

struct LocalizationOptions {
  std::string method = "hyperbola";
  MethodSettings settings;  ///< Of which the method takes those that it has.
  KnownBeforehand known;
  int threads = 1;
  std::vector<Method> methods = built_in_methods();  ///< To which one's own can be added.
  OnLocating on_locating{};                          ///< Or null.
};

/// Runs a method and holds what it says against the phases once more: places that chance explains
/// as well, that a phase of the other sign does, or that antennas would have to look away from are
/// taken back (plausibility.h, aim.h), as are those where no tag can be.
LocalizationResult locate_problem(const Method& method, const LocalizationProblem& problem,
                                  int threads, Diagnostics& diagnostics);

/// Locates every tag in `reads` by the method that `options` names. Reads may come in any order;
/// poses give the antennas' believed places. Deterministic, whatever the number of threads. Throws
/// Error on options out of their range.
LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics);
LocalizationResult locate_tags(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
