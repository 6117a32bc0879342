#include "tagfield/experiment/bench/suite_yaml.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <limits>
#include <set>

#include "tagfield/base/spelling.h"
#include "tagfield/base/units.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/scenario/yaml_values.h"

namespace tagfield {
namespace fs = std::filesystem;
namespace {

constexpr NumberRange kPositive = NumberRange::kPositive;
constexpr NumberRange kNotNegative = NumberRange::kNotNegative;
constexpr std::uint64_t kMostSeeds = 1'000'000;
constexpr double kLeastEvery_s = 1e-3;

/// A value as YAML text on one line.
std::string text_of(const YAML::Node& node) {
  YAML::Emitter emitter;
  emitter.SetSeqFormat(YAML::Flow);
  emitter.SetMapFormat(YAML::Flow);
  emitter << node;
  return emitter.c_str();
}

/// The keys of a mapping, each with `prefix` before it, and what stands there.
std::vector<Override> overrides_of(const YamlValue& value, const std::string& prefix) {
  const YamlMap checked(value);  // Throws unless it is a mapping whose keys are unique.
  std::vector<Override> overrides;
  for (const auto& entry : checked.self().node()) {
    const std::string key = YamlValue(entry.first, value.file(), value.path()).text();
    if (entry.second.IsNull()) {
      YamlValue(entry.first, value.file(), value.path())
          .fail(fmt::format("gives '{}' no value", key));
    }
    overrides.emplace_back(prefix + key, text_of(entry.second));
  }
  return overrides;
}

std::uint64_t count_of(const YamlValue& value) {
  const std::uint64_t count = value.whole_number();
  if (count < 1 || count > kMostSeeds) {
    value.fail(fmt::format("must be from 1 to {}, is {}", kMostSeeds, count));
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
  method.method = map.at("method").text();
  method.name = map.text("name", method.method);
  if (map.has("localization")) {
    method.localization = overrides_of(map.at("localization"), "localization.");
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
  if (map.has("every_s") && loss.every_s < kLeastEvery_s) {
    map.at("every_s").fail(
        fmt::format("must be at least {} s, is {}", kLeastEvery_s, loss.every_s));
  }
  if (loss.burst_s > 0.0) static_cast<void>(map.at("every_s"));
  map.finish();
  return loss;
}

PoseErrorModel model_of(YamlMap map) {
  PoseErrorModel model;
  model.sigma_m = map.at("sigma_m").number(kNotNegative);
  model.yaw_sigma_rad = radians(map.number("yaw_sigma_deg", 0.0, kNotNegative));
  model.time_constant_s = map.number("time_constant_s", model.time_constant_s, kPositive);
  map.finish();
  return model;
}

ToldPoseError believed_of(const YamlValue& value) {
  if (value.node().IsMap()) return model_of(YamlMap(value));
  if (choice(value, {"unknown", "exact"}) == 0) return UnknownPoseError{};
  return PoseErrorModel{};
}

std::string scenario_of(const YamlValue& value) {
  std::string path = resolve_path(value);
  if (!fs::is_regular_file(path))
    value.fail(fmt::format("is '{}', but there is no such file", path));
  return path;
}

/// What holds for all conditions that don't say it themselves.
struct Common {
  std::string scenario;
  std::optional<double> phase_noise_rad;
};

void append(std::vector<Override>& overrides, const std::vector<Override>& more) {
  overrides.insert(overrides.end(), more.begin(), more.end());
}

Condition condition_of(YamlMap map, const Common& common) {
  Condition condition;
  condition.location = map.self().location();
  condition.name = map.at("name").text();
  condition.scenario = map.has("scenario") ? scenario_of(map.at("scenario")) : common.scenario;
  if (condition.scenario.empty()) map.self().fail("has no 'scenario', and neither has the suite");
  if (map.has("set")) append(condition.settings, overrides_of(map.at("set"), ""));
  if (map.has("localization")) {
    append(condition.settings, overrides_of(map.at("localization"), "localization."));
  }
  if (map.has("seeds")) condition.count = count_of(map.at("seeds"));
  if (map.has("lose")) condition.lose = loss_of(YamlMap(map.at("lose")));
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

void require_known(const std::string& name, const std::vector<std::string>& known,
                   const Location& location, const char* kind) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  fail(location, fmt::format("there is no {} '{}'{}", kind, name, suggestion(name, known)));
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

Suite suite_of(YamlMap map) {
  Suite suite;
  suite.name = map.text("name", fs::path(map.self().file()).stem().string());
  suite.description = map.text("description", "");
  Common common;
  if (map.has("scenario")) common.scenario = scenario_of(map.at("scenario"));
  if (map.has("phase_noise_rad")) {
    common.phase_noise_rad = map.at("phase_noise_rad").number(kPositive);
  }
  if (map.has("seeds")) read_seeds(map.at("seeds"), suite);
  for (const YamlValue& method : map.at("methods").list())
    suite.methods.push_back(method_of(method));
  for (const YamlValue& condition : map.at("conditions").list()) {
    suite.conditions.push_back(condition_of(YamlMap(condition), common));
  }
  if (suite.methods.empty()) map.at("methods").fail("must have at least one method");
  if (suite.conditions.empty()) map.at("conditions").fail("must have at least one condition");
  map.finish();
  check(suite);
  return suite;
}

template <typename Named>
void keep_only(std::vector<Named>& things, const std::vector<std::string>& names,
               const char* option, const char* kind) {
  if (names.empty()) return;
  for (const std::string& name : names) {
    require_known(name, names_of(things), {option, 0}, kind);
  }
  std::erase_if(things, [&](const Named& thing) {
    return std::find(names.begin(), names.end(), thing.name) == names.end();
  });
}

}  // namespace

Suite load_suite(const std::string& path) {
  const YAML::Node root = read_yaml(path);
  try {
    return suite_of(YamlMap(YamlValue(root, path, "")));
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, error.msg);
  }
}

Suite only(const Suite& suite, const std::vector<std::string>& methods,
           const std::vector<std::string>& conditions) {
  Suite kept = suite;
  keep_only(kept.methods, methods, "--methods", "method");
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
