// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/sensor_parameters.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "tagfield/base/number.h"
#include "tagfield/base/spelling.h"
#include "tagfield/settings/sensor_radio.h"

namespace tagfield {
namespace {

double number_of(const RawParameter& parameter, const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value) {
    fail(parameter.location, fmt::format("<{}> is '{}', expected a number", parameter.key, text));
  }
  return *value;
}

/// All numeric parameters of a sensor's plugin, with the published defaults, which differ from a
/// scenario's.
struct Numbers {
  PaperAntenna paper{{865.7e6, 0.0, 0.1, 0.005, 250.0, {}}, 5.0, 0.05};
  double rate_hz = 15.0;
};

struct NumberSetting {
  const char* key;
  bool published;  ///< A warning is given if it is missing.
  bool physical;   ///< Also used by physical models.
  double& (*field)(Numbers&);
};

const std::array<NumberSetting, 8>& number_settings() {
  static const std::array<NumberSetting, 8> all = {{
      {"frequency", true, true, [](Numbers& n) -> double& { return n.paper.model.frequency_hz; }},
      {"noisephi", true, false,
       [](Numbers& n) -> double& { return n.paper.model.phase_noise_rad; }},
      {"noiserssi", true, false, [](Numbers& n) -> double& { return n.paper.model.rssi_noise; }},
      {"range", true, false, [](Numbers& n) -> double& { return n.paper.range_m; }},
      {"communication_gain", true, false,
       [](Numbers& n) -> double& { return n.paper.model.communication_gain; }},
      {"update_rate", true, true, [](Numbers& n) -> double& { return n.rate_hz; }},
      {"phase_offset", false, true,
       [](Numbers& n) -> double& { return n.paper.model.phase_offset_rad; }},
      {"range_sigma", false, false, [](Numbers& n) -> double& { return n.paper.range_sigma; }},
  }};
  return all;
}

const std::vector<std::string>& text_settings() {
  static const std::vector<std::string> all = {"optional_distribution",
                                               "optional_distribution_params",
                                               "model",
                                               "antenna",
                                               "reader",
                                               "seed",
                                               "robotNamespace",
                                               "frame_id",
                                               "parent_frame"};
  return all;
}

const RawParameter* find(const std::vector<RawParameter>& parameters, const std::string& key) {
  const auto found = std::find_if(parameters.begin(), parameters.end(),
                                  [&](const RawParameter& p) { return p.key == key; });
  return found == parameters.end() ? nullptr : &*found;
}

std::string text_of(const std::vector<RawParameter>& parameters, const std::string& key,
                    const std::string& otherwise) {
  const RawParameter* const given = find(parameters, key);
  return given == nullptr || given->value.empty() ? otherwise : given->value;
}

Numbers numbers_in(const std::vector<RawParameter>& parameters, const Location& location,
                   const std::string& antenna, bool is_physical, Diagnostics& diagnostics) {
  Numbers numbers;
  std::vector<std::string> missing;
  for (const NumberSetting& setting : number_settings()) {
    double& field = setting.field(numbers);
    if (const RawParameter* const given = find(parameters, setting.key)) {
      field = number_of(*given, given->value);
    } else if (setting.published && (setting.physical || !is_physical)) {
      missing.push_back(fmt::format("<{}> {:g}", setting.key, field));
    }
  }
  if (!missing.empty()) {
    diagnostics.warn(location, fmt::format("antenna '{}' uses the defaults of: {}", antenna,
                                           fmt::join(missing, ", ")));
  }
  return numbers;
}

void set_distribution(const std::vector<RawParameter>& parameters, PaperModel& model) {
  const RawParameter* const name = find(parameters, "optional_distribution");
  if (name == nullptr || name->value == "none" || name->value.empty()) return;
  const RawParameter* const numbers = find(parameters, "optional_distribution_params");
  const std::vector<double> values =
      numbers == nullptr ? std::vector<double>{} : numbers_of(*numbers);
  try {
    model.optional = make_distribution(name->value, values);
  } catch (const Error& error) {
    fail(name->location, fmt::format("<optional_distribution>: {}", error.what()));
  }
}

std::uint64_t seed_from(const std::vector<RawParameter>& parameters) {
  const RawParameter* const given = find(parameters, "seed");
  if (given == nullptr) return 1;
  std::uint64_t seed = 0;
  const char* const end = given->value.data() + given->value.size();
  const auto [rest, fault] = std::from_chars(given->value.data(), end, seed);
  if (fault != std::errc{} || rest != end) {
    fail(given->location,
         fmt::format("<seed> is '{}', expected a whole number, 0 or more, below 2^64",
                     given->value));
  }
  return seed;
}

void warn_of_unknown(const std::vector<RawParameter>& parameters, std::vector<std::string> known,
                     Diagnostics& diagnostics) {
  for (const RawParameter& parameter : parameters) {
    if (std::find(known.begin(), known.end(), parameter.key) == known.end()) {
      diagnostics.warn(parameter.location,
                       fmt::format("<{}> is not known and left out{}", parameter.key,
                                   suggestion(parameter.key, known)));
    }
  }
}

/// The message of a failed check with the parameter's name as in SDF.
std::string in_sdf_words(std::string message) {
  static const std::array<std::array<const char*, 2>, 9> words = {{
      {"frequency_hz", "<frequency>"},
      {"phase_noise_rad", "<noisephi>"},
      {"rssi_noise", "<noiserssi>"},
      {"range_m", "<range>"},
      {"range_sigma", "<range_sigma>"},
      {"communication_gain", "<communication_gain>"},
      {"rate_hz", "<update_rate>"},
      {"phase_offset_rad", "<phase_offset>"},
      {"sensitivity_dbm", "<sensitivity_dbm>"},
  }};
  for (const auto& [ours, theirs] : words) {
    if (message.rfind(ours, 0) == 0) return message.replace(0, std::string(ours).size(), theirs);
  }
  return message;
}

}  // namespace

std::vector<double> numbers_of(const RawParameter& parameter) {
  std::vector<double> numbers;
  std::istringstream words(parameter.value);
  for (std::string word; words >> word;) numbers.push_back(number_of(parameter, word));
  return numbers;
}

SensorAntenna antenna_from(const std::string& sensor, const std::vector<RawParameter>& parameters,
                           const Location& location, Diagnostics& diagnostics) {
  SensorAntenna antenna;
  antenna.parameters.name = text_of(parameters, "antenna", sensor);
  antenna.parameters.reader = text_of(parameters, "reader", antenna.parameters.name);
  const auto radio = sensor_radio(parameters, location, diagnostics);
  Numbers numbers =
      numbers_in(parameters, location, antenna.parameters.name, radio != nullptr, diagnostics);
  set_distribution(parameters, numbers.paper.model);
  antenna.parameters.rate_hz = numbers.rate_hz;
  if (radio) {
    antenna.parameters.model = radio;
  } else {
    if (const RawParameter* const given = find(parameters, "sensitivity_dbm")) {
      numbers.paper.sensitivity_dbm = number_of(*given, given->value);
    }
    antenna.parameters.model = numbers.paper;
  }
  antenna.seed = seed_from(parameters);
  antenna.name_space = text_of(parameters, "robotNamespace", "");
  antenna.frame_id = text_of(parameters, "frame_id", antenna.parameters.name);
  antenna.parent_frame = text_of(parameters, "parent_frame", "");
  std::vector<std::string> known = antenna_setting_keys();
  known.insert(known.begin(), text_settings().begin(), text_settings().end());
  for (const NumberSetting& setting : number_settings()) known.emplace_back(setting.key);
  warn_of_unknown(parameters, std::move(known), diagnostics);
  try {
    check(antenna.parameters);
  } catch (const Error& error) {
    fail(location,
         fmt::format("antenna '{}': {}", antenna.parameters.name, in_sdf_words(error.what())));
  }
  return antenna;
}

SensorTag tag_from(const std::vector<RawParameter>& parameters, const Location& location,
                   Diagnostics& diagnostics) {
  std::vector<std::string> known = tag_setting_keys();
  known.insert(known.begin(), {"epc", "update_rate"});
  warn_of_unknown(parameters, std::move(known), diagnostics);
  SensorTag tag;
  if (const RawParameter* const given = find(parameters, "epc")) {
    if (given->value.empty()) fail(given->location, "<epc> is empty, expected the tag's ID");
    tag.epc = given->value;
  }
  tag.model = sensor_tag_model(parameters, location, diagnostics);
  return tag;
}

}  // namespace tagfield
