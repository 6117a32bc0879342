// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/bench/prepared.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "tagfield/base/spelling.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/internal/recorded_run.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/field/antenna_facts.h"
#include "tagfield/localization/locate.h"
#include "tagfield/report/summary.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

/// Runs `work` and prefixes its errors with the location in the suite.
template <typename Work>
auto at_place(const Location& location, const std::string& what, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    std::string said = error.what();
    // Errors about overrides name the command-line option, which was not used here.
    if (said.rfind("--set", 0) == 0) said.erase(0, 2);
    fail(location, fmt::format("{}: {}", what, said));
  }
}

std::string called(const Condition& condition) {
  return fmt::format("condition '{}'", condition.name);
}

KnownBeforehand known_in(const Scenario& scenario, const Condition& condition) {
  KnownBeforehand known = known_beforehand(scenario);
  if (std::holds_alternative<UnknownPoseError>(condition.believed)) known.pose_error.reset();
  if (const auto* stated = std::get_if<PoseErrorModel>(&condition.believed)) {
    known.pose_error = *stated;
  }
  return known;
}

constexpr const char* kOfLocalization = "localization.";

/// The condition's settings. Settings of any method that runs in it are allowed.
std::vector<Override> overrides_of(const Suite& suite, const Condition& condition) {
  std::vector<std::string> names;
  for (const SuiteMethod& method : suite.methods) {
    if (runs_in(method, condition)) names.push_back(method.method);
  }
  std::vector<Override> overrides = condition.settings;
  overrides.emplace_back("localization.compare", fmt::format("[{}]", fmt::join(names, ", ")));
  return overrides;
}

/// Throws Error on a setting that belongs to other methods.
void refuse_others(const SuiteMethod& method, const std::vector<Method>& methods) {
  for (const auto& [path, value] : method.localization) {
    const std::string key = path.substr(std::string(kOfLocalization).size());
    const bool of_any = std::any_of(methods.begin(), methods.end(),
                                    [&](const Method& any) { return has_key(any.settings, key); });
    if (of_any) refuse_unused({{key, value, {}}}, {find_method(methods, method.method)}, methods);
  }
}

/// Keys and values of methods' settings, without the scenario's path prefix. Throws Error on
/// anything that is not a setting of localization.
MethodSettings settings_in(const std::vector<Override>& overrides) {
  MethodSettings settings;
  for (const auto& [path, value] : overrides) {
    if (path.rfind(kOfLocalization, 0) != 0) throw Error(path + " has no effect on a recording");
    settings.push_back({path.substr(std::string(kOfLocalization).size()), value, {}});
  }
  return settings;
}

ScenarioWithWorld scenario_in(const Condition& condition, const std::vector<Override>& overrides,
                              const std::vector<Method>& methods, Diagnostics& diagnostics) {
  if (condition.make_scenario) return condition.make_scenario(overrides, diagnostics, methods);
  return load_scenario_with_world(condition.scenario, overrides, diagnostics, condition.world,
                                  methods);
}

/// The settings of localization, which don't depend on the world.
LocalizationSpec localization_in(const Condition& condition, const std::vector<Override>& overrides,
                                 const std::vector<Method>& methods) {
  Diagnostics unheard;
  if (condition.make_scenario) {
    return condition.make_scenario(overrides, unheard, methods).scenario.localization;
  }
  return load_scenario(condition.scenario, overrides, unheard, methods).localization;
}

/// Without a scenario, only the methods' settings are available.
PreparedMethod prepare_for_recording(const SuiteMethod& method, const Condition& condition,
                                     const std::vector<Method>& methods) {
  PreparedMethod ready;
  ready.name = method.name;
  const Method found = find_method(methods, method.method);
  MethodSettings settings = settings_in(condition.settings);
  const MethodSettings own = settings_in(method.localization);
  refuse_unused(own, {found}, methods);
  settings.insert(settings.end(), own.begin(), own.end());
  ready.method = configured(found, settings);
  return ready;
}

PreparedMethod prepare_method(const Suite& suite, const SuiteMethod& method,
                              const PreparedCondition& prepared,
                              const std::vector<Method>& methods) {
  PreparedMethod ready;
  if (prepared.condition.recording) {
    return prepare_for_recording(method, prepared.condition, methods);
  }
  ready.name = method.name;
  Scenario scenario = prepared.scenario;
  if (!method.localization.empty()) {
    refuse_others(method, methods);
    std::vector<Override> overrides = overrides_of(suite, prepared.condition);
    overrides.insert(overrides.end(), method.localization.begin(), method.localization.end());
    scenario.localization = localization_in(prepared.condition, overrides, methods);
    ready.known = known_in(scenario, prepared.condition);
  }
  ready.method = configured(find_method(methods, method.method), scenario.localization.settings);
  return ready;
}

void find_phase_noise(PreparedCondition& prepared) {
  const std::optional<double>& given = prepared.condition.phase_noise_rad;
  for (const AntennaSpec& antenna : prepared.scenario.antennas) {
    const AntennaParameters& parameters = antenna.parameters;
    const std::optional<StatedPhase> stated = stated_phase(parameters);
    if (!given && !stated) {
      prepared.no_bound =
          "the physical models state no phase noise, and phase_noise_rad is not given";
      return;
    }
    const double noise_rad = given ? *given : stated->noise_rad;
    if (!(noise_rad > 0.0)) {
      prepared.no_bound = fmt::format("antenna '{}' has no phase noise", parameters.name);
      return;
    }
    prepared.phase_noise_rad[parameters.name] = noise_rad;
  }
}

/// Throws Error on a fault that these reads can't have.
void require_faults_possible(const Condition& condition, const std::vector<std::string>& antennas,
                             std::size_t tags) {
  if (!condition.fault) return;
  for (const std::string& name : condition.fault->swapped_antennas) {
    if (std::find(antennas.begin(), antennas.end(), name) != antennas.end()) continue;
    throw Error(fmt::format("fault.swapped_antennas: there is no antenna '{}'{}", name,
                            suggestion(name, antennas)));
  }
  if (condition.fault->duplicate_epcs && tags < 2) {
    throw Error("fault.duplicate_epcs needs two tags at least");
  }
}

void load(const Suite& suite, const std::vector<Method>& methods, PreparedCondition& prepared,
          Diagnostics& diagnostics) {
  const Condition& condition = prepared.condition;
  ScenarioWithWorld loaded =
      scenario_in(condition, overrides_of(suite, condition), methods, diagnostics);
  prepared.scenario = std::move(loaded.scenario);
  prepared.scenario.real_time = 0.0;  // Run at full speed.
  prepared.known = known_in(prepared.scenario, condition);
  if (prepared.scenario.pose.source == PoseSource::kSlam) {
    prepared.world = navigation_world(prepared.scenario, loaded.scene, diagnostics);
  }
  std::vector<std::string> antennas;
  for (const AntennaSpec& antenna : prepared.scenario.antennas) {
    antennas.push_back(antenna.parameters.name);
  }
  require_faults_possible(condition, antennas, prepared.scenario.tags.size());
  find_phase_noise(prepared);
  if (condition.fault) prepared.no_bound = "the reads are faulty";
}

/// Throws Error on a setting that none of the condition's methods has.
void refuse_unused_settings(const Suite& suite, const std::vector<Method>& methods,
                            const Condition& condition) {
  std::vector<Method> used;
  for (const SuiteMethod& method : suite.methods) {
    if (runs_in(method, condition)) used.push_back(find_method(methods, method.method));
  }
  refuse_unused(settings_in(condition.settings), used, methods);
}

void load_recorded(const Suite& suite, const std::vector<Method>& methods,
                   const ReadRecording& read, PreparedCondition& prepared,
                   Diagnostics& diagnostics) {
  const Condition& condition = prepared.condition;
  refuse_unused_settings(suite, methods, condition);
  prepared.recording = load_recording(*condition.recording, read, diagnostics);
  prepared.known = known_of(*condition.recording, condition.believed);
  std::set<std::string> antennas;
  for (const TagRead& of : prepared.recording->reads) antennas.insert(of.antenna);
  require_faults_possible(condition, {antennas.begin(), antennas.end()},
                          count_by_tag(prepared.recording->reads).size());
  prepared.no_bound = "the phase noise of a recording is unknown";
}

PreparedCondition prepare_condition(const Suite& suite, const Condition& condition,
                                    const std::vector<Method>& methods, const ReadRecording& read,
                                    Diagnostics& diagnostics) {
  PreparedCondition prepared;
  prepared.condition = condition;
  prepared.runs = condition.recording ? 1 : condition.count.value_or(suite.count);
  Diagnostics warnings;
  at_place(condition.location, called(condition), [&] {
    if (condition.recording) {
      load_recorded(suite, methods, read, prepared, warnings);
    } else {
      load(suite, methods, prepared, warnings);
    }
  });
  for (const std::string& warning : warnings.warnings()) {
    diagnostics.warn(called(condition) + ": " + warning);
  }
  for (const SuiteMethod& method : suite.methods) {
    if (!runs_in(method, condition)) continue;
    prepared.methods.push_back(
        at_place(method.location, fmt::format("method '{}' in {}", method.name, called(condition)),
                 [&] { return prepare_method(suite, method, prepared, methods); }));
  }
  return prepared;
}

/// Called before any world is loaded, as that takes time.
void require_known_methods(const Suite& suite, const std::vector<Method>& methods) {
  for (const SuiteMethod& method : suite.methods) {
    at_place(method.location, fmt::format("method '{}'", method.name),
             [&] { find_method(methods, method.method); });
  }
}

}  // namespace

PreparedSuite prepare(const Suite& suite, const std::vector<Method>& methods,
                      Diagnostics& diagnostics, const ReadRecording& read) {
  require_known_methods(suite, methods);
  PreparedSuite prepared;
  prepared.suite = suite;
  for (const Condition& condition : suite.conditions) {
    const auto missing = condition.recording ? missing_file(*condition.recording) : std::nullopt;
    if (missing) {
      diagnostics.warn(condition.location,
                       fmt::format("{} is skipped: there is no {}", called(condition), *missing));
      continue;
    }
    prepared.conditions.push_back(prepare_condition(suite, condition, methods, read, diagnostics));
  }
  return prepared;
}

std::optional<PoseErrorModel> true_pose_error(const Scenario& scenario) {
  const PoseBelief& pose = scenario.pose;
  if (pose.source == PoseSource::kTrue) return PoseErrorModel{};
  if (pose.source != PoseSource::kNoisy) return std::nullopt;
  return PoseErrorModel{pose.sigma_m, pose.yaw_sigma_rad, pose.time_constant_s};
}

}  // namespace tagfield
