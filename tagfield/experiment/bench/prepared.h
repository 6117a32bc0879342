// SPDX-License-Identifier: Apache-2.0
/// @file
/// A suite made ready to run: scenarios and worlds read, methods found, everything checked.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/method.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"
#include "tagfield/stream/recording.h"

namespace tagfield {

/// What a recording holds.
struct RecordedReads {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;  ///< Of the antennas.
};

/// Reads a recording's tables, in whatever form they are. Throws Error.
using ReadRecording = std::function<RecordedReads(const SuiteRecording&)>;

struct PreparedMethod {
  std::string name;  ///< In the suite.
  Method method;
  /// What it knows beforehand, where that is not what the condition says.
  std::optional<KnownBeforehand> known;
};

struct PreparedCondition {
  Condition condition;
  Scenario scenario;                     ///< Empty of a recording.
  std::optional<Recording> recording;    ///< With the tags' places.
  std::optional<NavigationWorld> world;  ///< For robots that find their way by themselves.
  KnownBeforehand known;                 ///< Of all methods that don't know something else.
  std::vector<PreparedMethod> methods;
  std::uint64_t runs = 1;
  /// Standard deviation by antenna, for the bound.
  std::map<std::string, double> phase_noise_rad;
  std::string no_bound;  ///< Why there is no bound; "" where there is one.
};

struct PreparedSuite {
  Suite suite;
  std::vector<PreparedCondition> conditions;
};

/// Reads the scenarios and their worlds, and recordings by `read`. `methods`: those that the suite
/// may name. Conditions of recordings that are not there are left out, with a warning. Throws
/// Error, which begins with the place in the suite, on whatever could not be run.
PreparedSuite prepare(const Suite& suite, const std::vector<Method>& methods,
                      Diagnostics& diagnostics, const ReadRecording& read = {});

/// The model that the scenario's pose error really has; none where nobody knows one.
std::optional<PoseErrorModel> true_pose_error(const Scenario& scenario);

}  // namespace tagfield
