/// @file
/// The door of this room: reads and antenna poses in, an estimate for each tag out, by any method.
/// Knows nothing of where the tags really are.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/method_settings.h"
#include "tagfield/localization/problem.h"
#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

/// All methods that come with Tagfield, in the order in which people are told of them.
std::vector<Method> built_in_methods(const MethodSettings& settings);

/// The method of that name. Throws Error on an unknown one, with the nearest known.
Method find_method(const std::vector<Method>& methods, const std::string& name);

struct LocalizationOptions {
  std::string method = "hyperbola";
  MethodSettings settings;
  KnownBeforehand known;
  int threads = 1;
};

/// Locates every tag in `reads` by the method that `options` names. Reads may come in any order;
/// poses give the antennas' believed places. Deterministic, whatever the number of threads. Throws
/// Error on options out of their range.
LocalizationResult locate_tags(const std::vector<TagRead>& reads,
                               const std::vector<AntennaPose>& poses,
                               const LocalizationOptions& options, Diagnostics& diagnostics);

}  // namespace tagfield
