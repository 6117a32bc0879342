// SPDX-License-Identifier: Apache-2.0
/// @file
/// The input of a comparison of methods, as plain structs and read from YAML. docs/bench.md
/// describes the format.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/localization/method.h"
#include "tagfield/localization/problem.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {

struct SweepDesign;  // of sweep/design.h

/// A method under a name of its own, with settings of its own.
struct SuiteMethod {
  std::string name;                    ///< In tables and legends, unique.
  std::string method;                  ///< "hyperbola"
  std::vector<Override> localization;  ///< Of the scenario, with paths "localization.KEY".
  Location location;                   ///< Location in the file, for messages.
  /// A program to run as the method `method`, which the user of the suite must allow; "" for none.
  /// This module never starts it.
  std::string command{};
};

/// Random loss of reads.
struct ReadLoss {
  double share = 0.0;    ///< Of the reads, independently of each other, in [0, 1].
  double burst_s = 0.0;  ///< Duration of a burst in which nothing is read,
  double every_s = 0.0;  ///< and mean interval of their random begins; 0 for never.
};

/// Faults in the reads and poses that the methods get, in addition to noise.
struct Faults {
  bool random_phases = false;     ///< Each phase is drawn uniformly from all angles.
  bool constant_phases = false;   ///< All reads of a tag have the same random phase.
  bool wrong_phase_sign = false;  ///< Phases decrease with distance.
  bool random_rssi = false;       ///< Each RSSI is drawn uniformly from −75 to −35 dBm.
  bool duplicate_epcs = false;    ///< Every other read of a tag has the next tag's ID.
  double timestamp_delay_s =
      0.0;  ///< Delay of the reads' timestamps relative to those of the poses.
  std::vector<std::string> swapped_antennas;  ///< Two, whose names are swapped in the reads.
  bool poses_of_another_run = false;          ///< The poses are those of another path.
};

/// Recorded reads to localize from instead of simulated ones. "" for anything not given.
struct SuiteRecording {
  std::string reads;       ///< A table, a folder of tables, or an archive of either.
  std::string format;      ///< Of third-party tables: a name in profiles/datasets, or a file.
  std::string poses;       ///< A table, if that of the reads has no antenna poses.
  std::string truth;       ///< A table: the tags' positions.
  std::string experiment;  ///< Only truth rows with this in the column experiment are used.
  std::string heights;     ///< A table: the known heights of tags.
  std::optional<double> tag_height_m;  ///< Of all tags that are not in the table.
  TagArea area;                        ///< Where tags can be.
};

/// Nothing is known of the pose error.
struct UnknownPoseError {};

/// What localization knows about the pose error: what the scenario states, nothing, or this model.
using StatedPoseError = std::variant<std::monostate, UnknownPoseError, PoseErrorModel>;

/// Makes a condition's scenario with these overrides, as load_scenario_with_world() does from a
/// file.
using MakeScenario = std::function<ScenarioWithWorld(const std::vector<Override>&, Diagnostics&,
                                                     const std::vector<Method>&)>;

/// One situation in which all methods are compared.
struct Condition {
  std::string name;                         ///< Unique.
  std::string scenario;                     ///< Path of the file; "" for a recording.
  MakeScenario make_scenario;               ///< Instead of a file; null if there is one.
  std::optional<SuiteRecording> recording;  ///< Instead of a scenario.
  std::vector<Override> settings;           ///< Of the scenario.
  std::optional<std::uint64_t> count;       ///< Number of seeds, instead of the suite's.
  std::optional<ReadLoss> lose;
  std::optional<Faults> fault;
  StatedPoseError believed;
  std::optional<double> phase_noise_rad;  ///< For the bound, if the signal model states none.
  std::vector<std::string> methods;       ///< Only these, by name; empty for all.
  WorldOptions world{};                   ///< In addition to the scenario's.
  Location location;                      ///< Location in the file, for messages.
};

/// The whole suite. Each method runs in each condition with each seed.
struct Suite {
  std::string name;
  std::string description;
  std::uint64_t first_seed = 1;
  std::uint64_t count = 1;  ///< Number of seeds.
  std::vector<SuiteMethod> methods;
  std::vector<Condition> conditions;
  /// The values that `tagfield sweep` runs each condition with; a bench has none.
  std::shared_ptr<const SweepDesign> sweep;
};

/// Reads a suite. Paths of scenarios are relative to the file. Throws Error "FILE:LINE: …".
Suite load_suite(const std::string& path);

/// Same, but from text that was read from the file `path`, possibly on another machine: whether the
/// scenarios exist is not checked.
Suite suite_from_text(const std::string& text, const std::string& path);

/// Sets the options for all conditions, in addition to those of their scenarios.
void set_world_options(const WorldOptions& options, Suite& suite);

/// The suite with only the methods and conditions of these names, in the suite's order; an empty
/// list keeps all. Conditions without any remaining method are removed, too. Throws Error on an
/// unknown name, suggesting the most similar one, and if nothing is left.
Suite only(const Suite& suite, const std::vector<std::string>& methods,
           const std::vector<std::string>& conditions);

/// Whether the method runs in this condition.
bool runs_in(const SuiteMethod& method, const Condition& condition);

}  // namespace tagfield
