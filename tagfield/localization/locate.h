// SPDX-License-Identifier: Apache-2.0
/// @file
/// Entry point of this module: takes reads and antenna poses and returns an estimate for each tag,
/// by any method. The true positions of the tags are not available to it.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// All methods that come with Tagfield, in the order in which they are listed for users.
std::vector<Method> built_in_methods();

/// Whether a built-in method relies on phases, so that it locates nothing without them; false for
/// user-defined methods.
bool is_by_phase(const std::string& method);

struct LocalizationOptions {
  std::string method = "hyperbola";
  MethodSettings settings;  ///< The method uses those that it has.
  KnownBeforehand known;
  int threads = 1;
  std::vector<Method> methods = built_in_methods();  ///< User-defined ones can be added.
  OnLocating on_locating{};                          ///< May be null.
};

/// Runs a method and checks its result against the phases once more. Withdraws positions that
/// random phases, or phases of the opposite sign, would explain as well, positions behind the
/// antennas (plausibility.h, aim.h), and positions outside the tag area. `problem` is changed
/// meanwhile, in place because copies of all reads take much memory, and restored.
LocalizationResult locate_problem(const Method& method, LocalizationProblem& problem, int threads,
                                  Diagnostics& diagnostics);

/// Locates every tag in `reads` by the method named in `options`. Reads may be in any order; poses
/// are the antennas' believed poses. Deterministic, regardless of the number of threads. Throws
/// Error if options are out of range.
LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics);
LocalizationResult locate_tags(const EachRead& each_read, const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
