#include "tagfield/experiment/bench/prepared.h"

#include <fmt/format.h>

#include "tagfield/field/antenna_facts.h"
#include "tagfield/base/spelling.h"
#include "tagfield/experiment/bench/suite_yaml.h"
#include "tagfield/experiment/known_beforehand.h"
#include "tagfield/localization/locate.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

/// Runs `work`; what it complains of gets the place in the suite before it.
template <typename Work>
auto at_place(const Location& location, const std::string& what, const Work& work) {
  try {
    return work();
  } catch (const Error& error) {
    std::string said = error.what();
    // Overrides call themselves by the option of the command line, which was not used here.
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
  if (const auto* told = std::get_if<PoseErrorModel>(&condition.believed)) {
    known.pose_error = *told;
  }
  return known;
}

/// The scenario with the method's own settings of localization.
Scenario with_settings_of(const SuiteMethod& method, const PreparedCondition& prepared) {
  std::vector<Override> overrides = prepared.condition.settings;
  overrides.insert(overrides.end(), method.localization.begin(), method.localization.end());
  Scenario scenario = prepared.scenario;
  scenario.localization = load_scenario(prepared.condition.scenario, overrides).localization;
  return scenario;
}

PreparedMethod prepare_method(const SuiteMethod& method, const PreparedCondition& prepared,
                              const MethodFactory& methods) {
  PreparedMethod ready;
  ready.name = method.name;
  const bool own = !method.localization.empty();
  const Scenario scenario = own ? with_settings_of(method, prepared) : prepared.scenario;
  ready.method = find_method(methods(scenario.localization.settings), method.method);
  if (own) ready.known = known_in(scenario, prepared.condition);
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

void load(PreparedCondition& prepared, Diagnostics& diagnostics) {
  const Condition& condition = prepared.condition;
  ScenarioWithWorld loaded =
      load_scenario_with_world(condition.scenario, condition.settings, diagnostics);
  prepared.scenario = std::move(loaded.scenario);
  prepared.scenario.real_time = 0.0;  // Nobody watches.
  prepared.known = known_in(prepared.scenario, condition);
  if (prepared.scenario.pose.source == PoseSource::kSlam) {
    prepared.world = navigation_world(prepared.scenario, loaded.scene, diagnostics);
  }
  find_phase_noise(prepared);
}

PreparedCondition prepare_condition(const Suite& suite, const Condition& condition,
                                    const MethodFactory& methods, Diagnostics& diagnostics) {
  PreparedCondition prepared;
  prepared.condition = condition;
  prepared.runs = condition.count.value_or(suite.count);
  Diagnostics warnings;
  at_place(condition.location, called(condition), [&] { load(prepared, warnings); });
  for (const std::string& warning : warnings.warnings()) {
    diagnostics.warn(called(condition) + ": " + warning);
  }
  for (const SuiteMethod& method : suite.methods) {
    if (!runs_in(method, condition)) continue;
    prepared.methods.push_back(
        at_place(method.location, fmt::format("method '{}' in {}", method.name, called(condition)),
                 [&] { return prepare_method(method, prepared, methods); }));
  }
  return prepared;
}

/// Before any world is read, as that takes its time.
void require_known_methods(const Suite& suite, const MethodFactory& methods) {
  const std::vector<Method> known = methods({});
  for (const SuiteMethod& method : suite.methods) {
    at_place(method.location, fmt::format("method '{}'", method.name),
             [&] { find_method(known, method.method); });
  }
}

}  // namespace

PreparedSuite prepare(const Suite& suite, const MethodFactory& methods, Diagnostics& diagnostics) {
  require_known_methods(suite, methods);
  PreparedSuite prepared;
  prepared.suite = suite;
  for (const Condition& condition : suite.conditions) {
    prepared.conditions.push_back(prepare_condition(suite, condition, methods, diagnostics));
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
