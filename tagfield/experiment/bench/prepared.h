// SPDX-License-Identifier: Apache-2.0
/// @file
/// A suite prepared for running: scenarios and worlds loaded, methods looked up, everything
/// checked.
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

/// The contents of a recording.
struct RecordedReads {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;  ///< Of the antennas.
};

/// Reads a recording's tables, whatever their format. Throws Error.
using ReadRecording = std::function<RecordedReads(const SuiteRecording&)>;

struct PreparedMethod {
  std::string name;  ///< In the suite.
  Method method;
  /// Its prior knowledge, if that differs from the condition's.
  std::optional<KnownBeforehand> known;
};

struct PreparedCondition {
  Condition condition;
  Scenario scenario;                     ///< Empty for a recording.
  std::optional<Recording> recording;    ///< With the tags' positions.
  std::optional<NavigationWorld> world;  ///< For robots that navigate by themselves.
  KnownBeforehand known;                 ///< For all methods without prior knowledge of their own.
  std::vector<PreparedMethod> methods;
  std::uint64_t runs = 1;
  /// Standard deviation by antenna, for the bound.
  std::map<std::string, double> phase_noise_rad;
  std::string no_bound;  ///< Why there is no bound; "" if there is one.
};

struct PreparedSuite {
  Suite suite;
  std::vector<PreparedCondition> conditions;
};

/// Loads the scenarios and their worlds, and recordings with `read`. `methods`: those that the
/// suite may name. Conditions whose recordings don't exist are left out, with a warning. Throws
/// Error, which begins with the location in the suite, on anything that could not be run.
PreparedSuite prepare(const Suite& suite, const std::vector<Method>& methods,
                      Diagnostics& diagnostics, const ReadRecording& read = {});

/// The true model of the scenario's pose error; none if it is unknown.
std::optional<PoseErrorModel> true_pose_error(const Scenario& scenario);

}  // namespace tagfield
