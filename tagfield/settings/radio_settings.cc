// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/radio_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>

#include "tagfield/base/units.h"
#include "tagfield/settings/internal/setting_tables.h"

namespace tagfield {
namespace {

using settings_internal::antenna_table;
using settings_internal::AntennaDraft;
using settings_internal::choice_in;
using settings_internal::Setting;
using settings_internal::tag_table;

template <class Model>
void check_at(const Model& model, const std::vector<RawParameter>& parameters,
              const Location& location, Diagnostics& diagnostics) {
  Diagnostics found;
  try {
    check(model, found);
  } catch (const Error& error) {
    fail(place_of(error.what(), parameters, location), error.what());
  }
  for (const std::string& warning : found.warnings()) diagnostics.warn(location, warning);
}

AntennaDraft default_draft(PropagationModel model) {
  AntennaDraft draft;
  draft.model.antenna.shape = PatternShape::kPatch;
  draft.model.antenna.gain_dbi = 8.0;
  draft.model.antenna.beam_width_rad = radians(65.0);
  draft.model.antenna.vertical_beam_width_rad = radians(65.0);
  draft.model.antenna.polarization = PolarizationKind::kRightCircular;
  draft.model.plan = fixed_plan(865.7e6);
  constexpr int kUsualOrder = 2;
  draft.model.reflection_order = model == PropagationModel::kMultipath ? kUsualOrder : 0;
  return draft;
}

/// In the order of PropagationModel.
constexpr std::array<const char*, 3> kModels = {"paper", "link_budget", "multipath"};

/// Appends the parameters that are in the table; no others were applied.
template <class T>
void add_settings(const std::vector<Setting<T>>& table, const std::vector<RawParameter>& parameters,
                  std::vector<RawParameter>& settings) {
  std::copy_if(parameters.begin(), parameters.end(), std::back_inserter(settings),
               [&](const RawParameter& p) { return find_setting(table, p.key) != nullptr; });
}

}  // namespace

const char* to_string(PropagationModel model) {
  return kModels.at(static_cast<std::size_t>(model));
}

PropagationModel propagation_model(const RawParameter& parameter) {
  try {
    return static_cast<PropagationModel>(
        choice_in(parameter.value, {kModels.begin(), kModels.end()}));
  } catch (const Error& error) {
    fail(parameter.location, fmt::format("{} {}", parameter.key, error.what()));
  }
}

const std::vector<SettingHelp>& antenna_settings() {
  static const std::vector<SettingHelp> all = helps_of(antenna_table());
  return all;
}

const std::vector<SettingHelp>& tag_settings() {
  static const std::vector<SettingHelp> all = helps_of(tag_table());
  return all;
}

bool is_antenna_setting(const std::string& key) {
  return find_setting(antenna_table(), key) != nullptr;
}
bool is_tag_setting(const std::string& key) { return find_setting(tag_table(), key) != nullptr; }

const RawParameter* last_of(const std::vector<RawParameter>& parameters, const std::string& key) {
  const auto found = std::find_if(parameters.rbegin(), parameters.rend(),
                                  [&](const RawParameter& p) { return p.key == key; });
  return found == parameters.rend() ? nullptr : &*found;
}

std::shared_ptr<const RadioModel> radio_model_from(PropagationModel model,
                                                   const std::vector<RawParameter>& parameters,
                                                   const Location& location,
                                                   Diagnostics& diagnostics) {
  AntennaDraft draft = default_draft(model);
  apply_settings(antenna_table(), parameters, draft);
  if (draft.takes_inventory) draft.model.gen2 = draft.gen2;
  // A link budget has no paths except the direct one, whatever the multipath settings say.
  if (model == PropagationModel::kLinkBudget) {
    draft.model.effects.reflections = false;
    draft.model.effects.diffraction = false;
    draft.model.effects.diffuse = false;
  }
  check_at(draft.model, parameters, location, diagnostics);
  draft.model.settings = {{"model", to_string(model), location}};
  add_settings(antenna_table(), parameters, draft.model.settings);
  return std::make_shared<const RadioModel>(draft.model);
}

std::shared_ptr<const TagModel> tag_model_from(const std::string& name,
                                               const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics) {
  TagModel tag = *default_tag_model();
  tag.name = name;
  apply_settings(tag_table(), parameters, tag);
  check_at(tag, parameters, location, diagnostics);
  add_settings(tag_table(), parameters, tag.settings);
  return std::make_shared<const TagModel>(tag);
}

}  // namespace tagfield
