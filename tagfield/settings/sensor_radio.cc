// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/sensor_radio.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/idle_settings.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {
namespace {

/// A published parameter and its equivalent setting.
struct Synonym {
  const char* sdf;
  const char* setting;
};
constexpr std::array<Synonym, 2> kSynonyms = {
    {{"frequency", "frequency_hz"}, {"phase_offset", "phase_offset_rad"}}};

using IsSetting = bool (*)(const std::string&);

/// The settings among `parameters`, the published ones first. Without locations, so that error
/// messages begin with a key.
std::vector<RawParameter> settings_in(const std::vector<RawParameter>& parameters,
                                      IsSetting is_setting) {
  std::vector<RawParameter> settings;
  for (const auto& [sdf, setting] : kSynonyms) {
    for (const RawParameter& parameter : parameters) {
      if (parameter.key == sdf && is_setting(setting)) {
        settings.push_back({setting, parameter.value, {}});
      }
    }
  }
  for (const RawParameter& parameter : parameters) {
    if (is_setting(parameter.key)) settings.push_back({parameter.key, parameter.value, {}});
  }
  return settings;
}

/// The element that an error message about the setting `key` refers to.
std::string element_of(const std::vector<RawParameter>& parameters, const std::string& key) {
  if (last_of(parameters, key) != nullptr) return key;
  for (const auto& [sdf, setting] : kSynonyms) {
    if (key == setting) return sdf;
  }
  return key;
}

/// Throws Error with a message that begins with a setting's key, named as in SDF and with its
/// location.
[[noreturn]] void fail_in_sdf_words(const std::string& message,
                                    const std::vector<RawParameter>& parameters,
                                    const Location& location, IsSetting is_setting) {
  const std::string key = message.substr(0, message.find(' '));
  if (key != "model" && !is_setting(key)) fail(location, message);
  const std::string element = element_of(parameters, key);
  const RawParameter* const given = last_of(parameters, element);
  fail(given == nullptr ? location : given->location,
       "<" + element + ">" + message.substr(key.size()));
}

/// The result of `make` for the settings; its warnings and errors are given their SDF location.
template <class Make>
auto made(const std::vector<RawParameter>& parameters, const Location& location,
          IsSetting is_setting, Diagnostics& diagnostics, const Make& make) {
  try {
    Diagnostics found;
    auto model = make(settings_in(parameters, is_setting), found);
    for (const std::string& warning : found.warnings()) diagnostics.warn(location, warning);
    return model;
  } catch (const Error& error) {
    fail_in_sdf_words(error.what(), parameters, location, is_setting);
  }
}

/// Warns about settings among `parameters` that have no effect in the model made from them,
/// RadioModel or TagModel. The published parameters are exempt, as every published sensor has them.
template <class Model>
void warn_of_idle(const std::vector<RawParameter>& parameters, const Model& model,
                  Diagnostics& found) {
  for (const RawParameter& parameter : parameters) {
    const auto why = why_idle(parameter.key, model);
    if (why) found.warn(fmt::format("<{}> has no effect {}", parameter.key, *why));
  }
}

/// The paper's model has elements of its own, and shares one with all models.
void require_no_setting(const std::vector<RawParameter>& parameters) {
  for (const RawParameter& parameter : parameters) {
    if (!is_antenna_setting(parameter.key) || parameter.key == "sensitivity_dbm") continue;
    throw Error(
        fmt::format("{} belongs to <model> link_budget or multipath, but the antenna is "
                    "simulated by <model> paper",
                    parameter.key));
  }
}

std::vector<std::string> keys_of(const std::vector<SettingHelp>& settings) {
  std::vector<std::string> keys;
  keys.reserve(settings.size());
  for (const SettingHelp& setting : settings) keys.push_back(setting.key);
  return keys;
}

}  // namespace

std::shared_ptr<const RadioModel> sensor_radio(const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics) {
  using Settings = std::vector<RawParameter>;
  const auto make = [&](const Settings& settings, Diagnostics& found) {
    const RawParameter* const model = last_of(parameters, "model");
    const PropagationModel kind = model == nullptr ? PropagationModel::kPaper
                                                   : propagation_model({"model", model->value, {}});
    if (kind == PropagationModel::kPaper) {
      require_no_setting(parameters);
      return std::shared_ptr<const RadioModel>();
    }
    auto radio = radio_model_from(kind, settings, {}, found);
    warn_of_idle(parameters, *radio, found);
    return radio;
  };
  return made(parameters, location, is_antenna_setting, diagnostics, make);
}

std::shared_ptr<const TagModel> sensor_tag_model(const std::vector<RawParameter>& parameters,
                                                 const Location& location,
                                                 Diagnostics& diagnostics) {
  using Settings = std::vector<RawParameter>;
  const auto make = [&](const Settings& settings, Diagnostics& found) {
    if (settings.empty()) return std::shared_ptr<const TagModel>();
    auto tag = tag_model_from("tag", settings, {}, found);
    warn_of_idle(parameters, *tag, found);
    return tag;
  };
  return made(parameters, location, is_tag_setting, diagnostics, make);
}

std::vector<std::string> antenna_setting_keys() { return keys_of(antenna_settings()); }
std::vector<std::string> tag_setting_keys() { return keys_of(tag_settings()); }

}  // namespace tagfield
