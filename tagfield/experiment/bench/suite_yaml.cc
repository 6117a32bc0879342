// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <limits>
#include <set>

#include "tagfield/base/file_kind.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/experiment/bench/suite.h"
#include "tagfield/experiment/internal/overrides_yaml.h"
#include "tagfield/experiment/sweep/design.h"
#include "tagfield/experiment/sweep/design_yaml.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

constexpr std::uint64_t kMaxSeeds = 1'000'000;
constexpr double kMaxBursts = 1000.0;  // Simultaneously active.
constexpr double kMinEvery_s = 1e-3;
constexpr double kMaxTimestampDelay_s = 3600.0;

std::uint64_t count_of(const YamlValue& value) {
  const std::uint64_t count = value.whole_number();
  if (count < 1 || count > kMaxSeeds) {
    value.fail(fmt::format("must be from 1 to {}, is {}", kMaxSeeds, count));
  }
  return count;
}

/// A number of seeds, or {first, count}.
void read_seeds(const YamlValue& value, Suite& suite) {
  if (!value.node().IsMap()) {
    suite.count = count_of(value);
    return;
  }
  YamlMap map(value);
  if (map.has("first")) suite.first_seed = map.at("first").whole_number();
  suite.count = count_of(map.at("count"));
  map.finish();
  if (suite.first_seed > std::numeric_limits<std::uint64_t>::max() - suite.count) {
    value.fail("goes beyond 2^64 - 1");
  }
}

SuiteMethod method_of(const YamlValue& value) {
  SuiteMethod method;
  method.location = value.location();
  if (!value.node().IsMap()) {
    method.name = method.method = value.text();
    return method;
  }
  YamlMap map(value);
  if (map.has("command")) {
    method.command = map.at("command").text();
    method.name = method.method = map.at("name").text();
    map.finish();
    return method;
  }
  method.method = map.at("method").text();
  method.name = map.text("name", method.method);
  if (map.has("localization")) {
    method.localization = overrides_in(map.at("localization"), "localization.");
  }
  map.finish();
  return method;
}

ReadLoss loss_of(YamlMap map) {
  ReadLoss loss;
  loss.share = map.number("share", loss.share, kNotNegative);
  if (loss.share > 1.0) map.at("share").fail(fmt::format("must be from 0 to 1, is {}", loss.share));
  loss.burst_s = map.number("burst_s", loss.burst_s, kNotNegative);
  loss.every_s = map.number("every_s", loss.every_s, kPositive);
  if (map.has("every_s") && loss.every_s < kMinEvery_s) {
    map.at("every_s").fail(fmt::format("must be at least {} s, is {}", kMinEvery_s, loss.every_s));
  }
  if (loss.burst_s > 0.0) static_cast<void>(map.at("every_s"));
  if (loss.burst_s > kMaxBursts * loss.every_s) {
    map.at("burst_s").fail(
        fmt::format("must be at most {} times every_s, is {}: nothing would be read", kMaxBursts,
                    loss.burst_s));
  }
  map.finish();
  return loss;
}

/// Whether the fault is set. Throws Error on `false`, which would be no fault at all.
bool is_set(YamlMap& map, const std::string& key) {
  if (!map.has(key)) return false;
  if (!map.at(key).boolean()) map.at(key).fail("is false: leave it out");
  return true;
}

std::vector<std::string> two_antennas(const YamlValue& value) {
  std::vector<std::string> names;
  for (const YamlValue& name : value.list()) names.push_back(name.text());
  if (names.size() != 2 || names[0] == names[1]) value.fail("must be the names of two antennas");
  return names;
}

Faults faults_in(YamlMap map) {
  Faults faults;
  faults.random_phases = is_set(map, "random_phases");
  faults.constant_phases = is_set(map, "constant_phases");
  faults.wrong_phase_sign = is_set(map, "wrong_phase_sign");
  faults.random_rssi = is_set(map, "random_rssi");
  faults.duplicate_epcs = is_set(map, "duplicate_epcs");
  faults.poses_of_another_run = is_set(map, "poses_of_another_run");
  if (map.has("timestamp_delay_s")) {
    faults.timestamp_delay_s = map.at("timestamp_delay_s").number(kPositive);
    if (faults.timestamp_delay_s > kMaxTimestampDelay_s) {
      map.at("timestamp_delay_s")
          .fail(fmt::format("must be at most {}, is {}", kMaxTimestampDelay_s,
                            faults.timestamp_delay_s));
    }
  }
  if (map.has("swapped_antennas")) {
    faults.swapped_antennas = two_antennas(map.at("swapped_antennas"));
  }
  map.finish();
  if (map.self().node().size() == 0) map.self().fail("names no fault");
  const std::array<bool, 3> of_phase = {faults.random_phases, faults.constant_phases,
                                        faults.wrong_phase_sign};
  if (std::count(of_phase.begin(), of_phase.end(), true) > 1) {
    map.self().fail("can have only one of random_phases, constant_phases and wrong_phase_sign");
  }
  return faults;
}

/// A single word, for a fault without parameters, or a mapping.
Faults faults_of(const YamlValue& value) {
  if (!value.node().IsScalar()) return faults_in(YamlMap(value));
  constexpr bool Faults::*kFaults[] = {&Faults::random_phases,    &Faults::constant_phases,
                                       &Faults::wrong_phase_sign, &Faults::random_rssi,
                                       &Faults::duplicate_epcs,   &Faults::poses_of_another_run};
  Faults faults;
  faults.*kFaults[choice(value, {"random_phases", "constant_phases", "wrong_phase_sign",
                                 "random_rssi", "duplicate_epcs", "poses_of_another_run"})] = true;
  return faults;
}

/// A path, or the name of a shipped format.
std::string format_of(const YamlValue& value) {
  const fs::path format(value.text());
  const bool is_name = !format.has_extension() && !format.has_parent_path();
  return is_name ? format.string() : resolve_path(value);
}

std::string path_of(YamlMap& map, const std::string& key) {
  return map.has(key) ? resolve_path(map.at(key)) : "";
}

SuiteRecording recording_of(YamlMap map) {
  SuiteRecording recording;
  recording.reads = resolve_path(map.at("reads"));
  recording.truth = resolve_path(map.at("truth"));
  if (map.has("format")) recording.format = format_of(map.at("format"));
  recording.poses = path_of(map, "poses");
  if (recording.format.empty() && recording.poses.empty()) {
    map.self().fail("has no 'poses', which tables in Tagfield's own form require, and no 'format'");
  }
  recording.experiment = map.text("experiment", "");
  recording.heights = path_of(map, "tag_heights");
  if (map.has("tag_height_m")) recording.tag_height_m = map.at("tag_height_m").number();
  recording.area = tag_area_of(map);
  map.finish();
  return recording;
}

/// Throws Error on keys that have no effect on a recording.
void refuse_beside_recording(YamlMap& map) {
  for (const char* key : {"scenario", "set", "seeds", "phase_noise_rad"}) {
    if (map.has(key)) map.at(key).fail("has no effect on a recording");
  }
}

PoseErrorModel model_of(YamlMap map) {
  PoseErrorModel model;
  model.sigma_m = map.at("sigma_m").number(kNotNegative);
  model.yaw_sigma_rad = radians(map.number("yaw_sigma_deg", 0.0, kNotNegative));
  model.time_constant_s = map.number("time_constant_s", model.time_constant_s, kPositive);
  map.finish();
  return model;
}

StatedPoseError believed_of(const YamlValue& value) {
  if (value.node().IsMap()) return model_of(YamlMap(value));
  if (choice(value, {"unknown", "exact"}) == 0) return UnknownPoseError{};
  return PoseErrorModel{};
}

/// Defaults for all conditions.
struct Common {
  bool on_disk = true;  ///< Whether scenarios must exist.
  std::string scenario;
  std::optional<double> phase_noise_rad;
};

std::string scenario_of(const YamlValue& value, const Common& common) {
  std::string path = resolve_path(value);
  if (common.on_disk && !is_file(path)) {
    value.fail(fmt::format("is '{}', but there is no such file", path));
  }
  return path;
}

void append(std::vector<Override>& overrides, const std::vector<Override>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
}

Condition condition_of(YamlMap map, const Common& common) {
  Condition condition;
  condition.location = map.self().location();
  condition.name = map.at("name").text();
  if (map.has("recording")) {
    refuse_beside_recording(map);
    condition.recording = recording_of(YamlMap(map.at("recording")));
  } else {
    condition.scenario =
        map.has("scenario") ? scenario_of(map.at("scenario"), common) : common.scenario;
    if (condition.scenario.empty()) map.self().fail("has no 'scenario', and neither has the suite");
  }
  if (map.has("set")) append(condition.settings, overrides_in(map.at("set"), ""));
  if (map.has("localization")) {
    append(condition.settings, overrides_in(map.at("localization"), "localization."));
  }
  if (map.has("seeds")) condition.count = count_of(map.at("seeds"));
  if (map.has("lose")) condition.lose = loss_of(YamlMap(map.at("lose")));
  if (map.has("fault")) condition.fault = faults_of(map.at("fault"));
  if (map.has("believed")) condition.believed = believed_of(map.at("believed"));
  condition.phase_noise_rad = common.phase_noise_rad;
  if (map.has("phase_noise_rad")) {
    condition.phase_noise_rad = map.at("phase_noise_rad").number(kPositive);
  }
  for (const YamlValue& method : map.list("methods")) condition.methods.push_back(method.text());
  map.finish();
  return condition;
}

template <typename Named>
std::vector<std::string> names_of(const std::vector<Named>& things) {
  std::vector<std::string> names;
  names.reserve(things.size());
  for (const Named& thing : things) names.push_back(thing.name);
  return names;
}

template <typename Named>
void require_unique_names(const std::vector<Named>& things, const char* kind) {
  std::set<std::string> names;
  for (const Named& thing : things) {
    if (names.insert(thing.name).second) continue;
    fail(thing.location, fmt::format("{} '{}' is there twice", kind, thing.name));
  }
}

/// `owner` is what would have it: "there is", "the suite has"; `advice` follows the message.
void require_known(const std::string& name, const std::vector<std::string>& known,
                   const Location& location, const char* kind, const char* owner = "there is",
                   const std::string& advice = "") {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  fail(location,
       fmt::format("{} no {} '{}'{}{}", owner, kind, name, suggestion(name, known), advice));
}

void check(const Suite& suite) {
  require_unique_names(suite.methods, "method");
  require_unique_names(suite.conditions, "condition");
  const std::vector<std::string> methods = names_of(suite.methods);
  for (const Condition& condition : suite.conditions) {
    for (const std::string& name : condition.methods) {
      require_known(name, methods, condition.location, "method");
    }
  }
}

/// The only condition of a sweep without `conditions`.
Condition only_condition(const YamlMap& map, const Common& common) {
  if (common.scenario.empty()) map.self().fail("has no 'scenario' and no 'conditions'");
  Condition condition;
  condition.name = fs::path(common.scenario).stem().string();
  condition.scenario = common.scenario;
  condition.phase_noise_rad = common.phase_noise_rad;
  condition.location = map.self().location();
  return condition;
}

Suite suite_of(YamlMap map, bool on_disk) {
  Suite suite;
  suite.name = map.text("name", fs::path(map.self().file()).stem().string());
  suite.description = map.text("description", "");
  Common common;
  common.on_disk = on_disk;
  if (map.has("scenario")) common.scenario = scenario_of(map.at("scenario"), common);
  if (map.has("phase_noise_rad")) {
    common.phase_noise_rad = map.at("phase_noise_rad").number(kPositive);
  }
  if (map.has("seeds")) read_seeds(map.at("seeds"), suite);
  if (!map.has("methods") && (map.has("antennas") || map.has("world"))) {
    map.self().fail("is a scenario, not a suite: 'tagfield run' simulates it (docs/bench.md)");
  }
  for (const YamlValue& method : map.at("methods").list())
    suite.methods.push_back(method_of(method));
  if (suite.methods.empty()) map.at("methods").fail("must have at least one method");
  if (map.has("sweep")) {
    suite.sweep = std::make_shared<SweepDesign>(
        sweep_design_of(map.at("sweep"), names_of(suite.methods), suite.count));
  }
  if (suite.sweep && !map.has("conditions")) {
    suite.conditions.push_back(only_condition(map, common));
  } else {
    for (const YamlValue& condition : map.at("conditions").list()) {
      suite.conditions.push_back(condition_of(YamlMap(condition), common));
    }
    if (suite.conditions.empty()) map.at("conditions").fail("must have at least one condition");
  }
  map.finish();
  check(suite);
  return suite;
}

Suite suite_in(const YAML::Node& root, const std::string& path, bool on_disk) {
  try {
    return suite_of(YamlMap(YamlValue(root, path, "")), on_disk);
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, error.msg);
  }
}

template <typename Named>
void keep_only(std::vector<Named>& things, const std::vector<std::string>& names,
               const char* option, const char* kind, const std::string& advice = "") {
  if (names.empty()) return;
  for (const std::string& name : names) {
    require_known(name, names_of(things), {option, 0}, kind, "the suite has", advice);
  }
  std::erase_if(things, [&](const Named& thing) {
    return std::find(names.begin(), names.end(), thing.name) == names.end();
  });
}

}  // namespace

Suite load_suite(const std::string& path) { return suite_in(read_yaml(path), path, true); }

Suite suite_from_text(const std::string& text, const std::string& path) {
  try {
    return suite_in(YAML::Load(text), path, false);
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, fmt::format("not valid YAML: {}", error.msg));
  }
}

void set_world_options(const WorldOptions& options, Suite& suite) {
  for (Condition& condition : suite.conditions) condition.world = options;
}

Suite only(const Suite& suite, const std::vector<std::string>& methods,
           const std::vector<std::string>& conditions) {
  Suite kept = suite;
  keep_only(kept.methods, methods, "--methods", "method", "; --command NAME=PROGRAM adds one");
  keep_only(kept.conditions, conditions, "--conditions", "condition");
  std::erase_if(kept.conditions, [&](const Condition& condition) {
    return std::none_of(kept.methods.begin(), kept.methods.end(),
                        [&](const SuiteMethod& method) { return runs_in(method, condition); });
  });
  if (kept.conditions.empty()) throw Error("none of these methods runs in any of these conditions");
  return kept;
}

bool runs_in(const SuiteMethod& method, const Condition& condition) {
  const std::vector<std::string>& only_these = condition.methods;
  return only_these.empty() ||
         std::find(only_these.begin(), only_these.end(), method.name) != only_these.end();
}

}  // namespace tagfield
