/// @file
/// What a comparison of methods is made of, as plain structs. docs/bench.md tells how to write one
/// as YAML.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

/// A method under a name of its own, with settings of its own.
struct SuiteMethod {
  std::string name;                    ///< In tables and legends, unique.
  std::string method;                  ///< "hyperbola"
  std::vector<Override> localization;  ///< Of the scenario's, with paths "localization.KEY".
  Location location;                   ///< Where it was written, for messages.
};

/// Reads that get lost on the way.
struct ReadLoss {
  double share = 0.0;    ///< Of the reads, each by itself, in [0, 1].
  double burst_s = 0.0;  ///< For so long nothing is read,
  double every_s = 0.0;  ///< beginning once in so long in the mean, at random; 0 for never.
};

/// Nothing is known of the pose error.
struct UnknownPoseError {};

/// What localization is told of the pose error: what the scenario says of it, nothing, or this.
using ToldPoseError = std::variant<std::monostate, UnknownPoseError, PoseErrorModel>;

/// One situation that all methods are put into.
struct Condition {
  std::string name;                    ///< Unique.
  std::string scenario;                ///< Path of the file.
  std::vector<Override> settings;      ///< Of the scenario.
  std::optional<std::uint64_t> count;  ///< Number of seeds, instead of the suite's.
  std::optional<ReadLoss> lose;
  ToldPoseError believed;
  std::optional<double> phase_noise_rad;  ///< For the bound, where the signal model tells none.
  std::vector<std::string> methods;       ///< Only these, by name; empty for all.
  Location location;                      ///< Where it was written, for messages.
};

/// All of it. Each method runs in each condition with each seed.
struct Suite {
  std::string name;
  std::string description;
  std::uint64_t first_seed = 1;
  std::uint64_t count = 1;  ///< Number of seeds.
  std::vector<SuiteMethod> methods;
  std::vector<Condition> conditions;
};

}  // namespace tagfield
