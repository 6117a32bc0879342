/// @file
/// A suite made ready to run: scenarios and worlds read, methods found, everything checked.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tagfield/experiment/bench/suite.h"
#include "tagfield/localization/method.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/simulator/navigation_world.h"

namespace tagfield {

struct PreparedMethod {
  std::string name;  ///< In the suite.
  Method method;
  /// What it knows beforehand, where that is not what the condition says.
  std::optional<KnownBeforehand> known;
};

struct PreparedCondition {
  Condition condition;
  Scenario scenario;
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

/// Reads the scenarios and their worlds. Throws Error, which begins with the place in the suite, on
/// whatever could not be run.
PreparedSuite prepare(const Suite& suite, const MethodFactory& methods, Diagnostics& diagnostics);

/// The model that the scenario's pose error really has; none where nobody knows one.
std::optional<PoseErrorModel> true_pose_error(const Scenario& scenario);

}  // namespace tagfield
