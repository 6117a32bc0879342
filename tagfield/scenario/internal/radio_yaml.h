// SPDX-License-Identifier: Apache-2.0
/// @file
/// The physical models' part of a scenario.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/yaml_map.h"
#include "tagfield/settings/radio_settings.h"

namespace tagfield {

/// A scalar, or a list's scalars separated by spaces, as the settings expect it.
RawParameter raw_parameter(const std::string& key, const YamlValue& value);

/// Defaults for all antennas and tags.
struct RadioDefaults {
  PropagationModel model = PropagationModel::kPaper;
  /// `diffraction`, `interference`, `tag_coupling`; overridden by an antenna's own.
  std::vector<RawParameter> antenna;
  std::vector<RawParameter> without;                          ///< Added to an antenna's own.
  std::shared_ptr<const TagModel> tag = default_tag_model();  ///< By `tag_profile`.
  /// Its name and parameters; a tag's own settings override them.
  std::string tag_profile = "tag";
  std::vector<RawParameter> tag_parameters;
};

/// Takes `model`, `diffraction`, `interference`, `tag_coupling`, `without` and `tag_profile`.
RadioDefaults radio_defaults_of(YamlMap& map, Diagnostics& diagnostics);

/// The antenna's physical model from its `profiles` and settings.
std::shared_ptr<const RadioModel> radio_model_of(YamlMap& antenna, PropagationModel model,
                                                 const RadioDefaults& defaults,
                                                 Diagnostics& diagnostics);

/// The tag's kind from its settings and its `profile`, or else the scenario's `tag_profile`.
std::shared_ptr<const TagModel> tag_model_of(YamlMap& tag, const RadioDefaults& defaults,
                                             Diagnostics& diagnostics);

/// The file of a profile that was given by path or by name.
std::string profile_file_of_tag(const YamlValue& value);
std::string profile_file_of_antenna(const YamlValue& value);

/// The scenario's material called `name`.
Material material_in(const RadioWorldOptions& options, const YamlValue& name);

/// The materials of the world: `world.materials`, `world.default_material`, `world.min_facet_m2`,
/// and the scenario's own `materials`.
RadioWorldOptions radio_world_options_of(YamlMap& scenario);

}  // namespace tagfield
