// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a comparison of methods is made of: plain structs, and read from YAML, which docs/bench.md
/// tells how to write.
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
  std::vector<Override> localization;  ///< Of the scenario's, with paths "localization.KEY".
  Location location;                   ///< Where it was written, for messages.
  /// A program to be run as the method `method`, which whoever runs the suite must allow; "" for
  /// none. This room starts none.
  std::string command{};
};

/// Reads that get lost on the way.
struct ReadLoss {
  double share = 0.0;    ///< Of the reads, each by itself, in [0, 1].
  double burst_s = 0.0;  ///< For so long nothing is read,
  double every_s = 0.0;  ///< beginning once in so long in the mean, at random; 0 for never.
};

/// What is wrong with the reads and poses that the methods get, besides noise.
struct Faults {
  bool random_phases = false;     ///< Each phase is drawn from all angles alike.
  bool constant_phases = false;   ///< All reads of a tag have one phase, which is drawn.
  bool wrong_phase_sign = false;  ///< Phases fall with distance.
  bool random_rssi = false;       ///< Each RSSI is drawn from −75 to −35 dBm.
  bool duplicate_epcs = false;    ///< Every other read of a tag has the next tag's ID.
  double late_stamps_s = 0.0;     ///< The reads' stamps are late by so much against the poses'.
  std::vector<std::string> swapped_antennas;  ///< Two whose names are exchanged in the reads.
  bool poses_of_another_run = false;  ///< The poses are those of a way that was not this one.
};

/// Reads that were recorded, to be located instead of simulated ones. "" for what is not told.
struct SuiteRecording {
  std::string reads;   ///< A table, a folder of tables, or an archive of either.
  std::string format;  ///< Of other people's tables: a name of profiles/datasets, or a file.
  std::string poses;   ///< A table, where the reads' own has no places of antennas.
  std::string truth;   ///< A table: the tags' places.
  std::string
      experiment;       ///< Of the truth only the rows that have this in their column experiment.
  std::string heights;  ///< A table: what is known of the tags' heights.
  std::optional<double> tag_height_m;  ///< Of all tags that the table doesn't have.
  TagArea area;                        ///< Where tags can be.
};

/// Nothing is known of the pose error.
struct UnknownPoseError {};

/// What localization is told of the pose error: what the scenario says of it, nothing, or this.
using ToldPoseError = std::variant<std::monostate, UnknownPoseError, PoseErrorModel>;

/// Makes a condition's scenario with these overrides, as load_scenario_with_world() does of a file.
using MakeScenario = std::function<ScenarioWithWorld(const std::vector<Override>&, Diagnostics&,
                                                     const std::vector<Method>&)>;

/// One situation that all methods are put into.
struct Condition {
  std::string name;                         ///< Unique.
  std::string scenario;                     ///< Path of the file; "" of a recording.
  MakeScenario make_scenario;               ///< Instead of a file; null where there is one.
  std::optional<SuiteRecording> recording;  ///< Instead of a scenario.
  std::vector<Override> settings;           ///< Of the scenario.
  std::optional<std::uint64_t> count;       ///< Number of seeds, instead of the suite's.
  std::optional<ReadLoss> lose;
  std::optional<Faults> fault;
  ToldPoseError believed;
  std::optional<double> phase_noise_rad;  ///< For the bound, where the signal model tells none.
  std::vector<std::string> methods;       ///< Only these, by name; empty for all.
  WorldOptions world{};                   ///< Beside what the scenario says.
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
  /// Of values that each condition is tried with, by `tagfield sweep`; a bench has none.
  std::shared_ptr<const SweepDesign> sweep;
};

/// Reads a suite. Paths of scenarios are relative to the file. Throws Error "FILE:LINE: …".
Suite load_suite(const std::string& path);

/// The same of a text, which was read from the file `path` here or elsewhere: whether scenarios are
/// there is not asked.
Suite suite_from_text(const std::string& text, const std::string& path);

/// Of all conditions, beside what their scenarios say.
void set_world_options(const WorldOptions& options, Suite& suite);

/// Only the methods and conditions of these names, in the suite's order; all where a list is empty.
/// Conditions that none of the methods is left for go too. Throws Error on a name that there is
/// not, with the nearest, and where nothing is left.
Suite only(const Suite& suite, const std::vector<std::string>& methods,
           const std::vector<std::string>& conditions);

/// Whether the method runs in this condition.
bool runs_in(const SuiteMethod& method, const Condition& condition);

}  // namespace tagfield
