// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/internal/antenna_model_yaml.h"

#include <fmt/format.h>

#include <array>

namespace tagfield {
namespace {

/// Keys of the paper's model that physical models don't have.
constexpr std::array<const char*, 7> kPaperKeys = {"range_m",
                                                   "range_sigma",
                                                   "phase_noise_rad",
                                                   "rssi_noise",
                                                   "communication_gain",
                                                   "optional_distribution",
                                                   "optional_distribution_params"};

constexpr const char* kPhysicalModels = "model: link_budget or model: multipath";

/// Whether the antenna key is common to the paper's and the physical models.
bool is_shared(const std::string& key) {
  return key == "frequency_hz" || key == "phase_offset_rad" || key == "sensitivity_dbm";
}

/// `other` if `map` has it, or else the first key that is a setting and not one of an antenna's
/// shared keys; none if there is neither.
std::optional<std::string> physical_key_in(YamlMap& map, const std::vector<SettingHelp>& settings,
                                           const char* other, bool is_antenna) {
  if (map.has(other)) return other;
  for (const SettingHelp& setting : settings) {
    if (!(is_antenna && is_shared(setting.key)) && map.has(setting.key)) return setting.key;
  }
  return std::nullopt;
}

OptionalDistribution distribution_of(YamlMap& map) {
  const std::vector<double> parameters = map.has("optional_distribution_params")
                                             ? map.at("optional_distribution_params").numbers(0)
                                             : std::vector<double>{};
  if (!map.has("optional_distribution")) {
    if (!parameters.empty()) {
      map.at("optional_distribution_params").fail("needs 'optional_distribution' beside it");
    }
    return {};
  }
  if (parameters.empty()) map.complain_of_slip("optional_distribution_params");
  const YamlValue name = map.at("optional_distribution");
  try {
    return make_distribution(name.text(), parameters);
  } catch (const Error& error) {
    fail(name.location(), fmt::format("{}: {}", name.path(), error.what()));
  }
}

PaperModel paper_model_of(YamlMap& map) {
  PaperModel model;
  model.frequency_hz = map.number("frequency_hz", model.frequency_hz, kPositive);
  model.phase_offset_rad = map.number("phase_offset_rad", model.phase_offset_rad);
  model.phase_noise_rad = map.number("phase_noise_rad", model.phase_noise_rad, kNotNegative);
  model.rssi_noise = map.number("rssi_noise", model.rssi_noise, kNotNegative);
  model.communication_gain = map.number("communication_gain", model.communication_gain, kPositive);
  model.optional = distribution_of(map);
  return model;
}

PaperAntenna paper_antenna_of(YamlMap& map) {
  PaperAntenna antenna;
  antenna.model = paper_model_of(map);
  antenna.range_m = map.number("range_m", antenna.range_m, kPositive);
  antenna.range_sigma = map.number("range_sigma", antenna.range_sigma, kNotNegative);
  if (map.has("sensitivity_dbm")) antenna.sensitivity_dbm = map.at("sensitivity_dbm").number();
  return antenna;
}

void warn_of_papers_keys(YamlMap& antenna, PropagationModel model, Diagnostics& diagnostics) {
  for (const char* const key : kPaperKeys) {
    if (!antenna.has(key)) continue;
    const YamlValue value = antenna.at(key);
    diagnostics.warn(value.location(),
                     fmt::format("{} belongs to model: paper and has no effect with model: {}",
                                 value.path(), to_string(model)));
  }
}

}  // namespace

AntennaModel antenna_model_of(YamlMap& antenna, const RadioDefaults& defaults,
                              Diagnostics& diagnostics) {
  PropagationModel model = defaults.model;
  if (antenna.has("model")) {
    model = propagation_model(raw_parameter("model", antenna.at("model")));
  }
  if (model != PropagationModel::kPaper) {
    warn_of_papers_keys(antenna, model, diagnostics);
    return radio_model_of(antenna, model, defaults, diagnostics);
  }
  if (const auto key = physical_key_in(antenna, antenna_settings(), "profiles", true)) {
    antenna.at(*key).fail(fmt::format("belongs to {}, but the antenna is simulated by model: paper",
                                      kPhysicalModels));
  }
  return paper_antenna_of(antenna);
}

std::optional<Error> key_without_physical_antenna(YamlMap& scenario) {
  const auto complaint = [](YamlMap& map, const std::string& key) {
    const YamlValue value = map.at(key);
    return Error(fmt::format("{}: {} belongs to {}, but all antennas are simulated by model: paper",
                             to_string(value.location()), value.path(), kPhysicalModels));
  };
  for (const char* const key :
       {"without", "diffraction", "interference", "tag_coupling", "tag_profile"}) {
    if (scenario.has(key)) return complaint(scenario, key);
  }
  for (const YamlValue& value : scenario.list("tags")) {
    YamlMap tag(value);
    if (const auto key = physical_key_in(tag, tag_settings(), "profile", false)) {
      return complaint(tag, *key);
    }
  }
  return std::nullopt;
}

}  // namespace tagfield
