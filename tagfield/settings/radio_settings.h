// SPDX-License-Identifier: Apache-2.0
/// @file
/// Physical models from keys and values: the same keys in scenarios, in profiles and in SDF.
/// docs/radio_settings.md lists them.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

struct RadioModel;
struct TagModel;

/// The model that an antenna is simulated with.
enum class PropagationModel { kPaper, kLinkBudget, kMultipath };

/// "paper", "link_budget" or "multipath". Throws Error on any other word.
PropagationModel propagation_model(const RawParameter& parameter);
const char* to_string(PropagationModel model);

/// All settings of an antenna, and of a tag.
const std::vector<SettingHelp>& antenna_settings();
const std::vector<SettingHelp>& tag_settings();

/// Whether antenna_settings() (tag_settings()) contains `key`.
bool is_antenna_setting(const std::string& key);
bool is_tag_setting(const std::string& key);

/// The last of the parameters with that key, which is the one in effect; null if there is none.
const RawParameter* last_of(const std::vector<RawParameter>& parameters, const std::string& key);

/// The model described by `parameters`, where later ones override earlier ones of the same key.
/// Defaults are those of RadioModel, except for a right-circular patch of 8 dBi and 65°, and
/// reflection order 0 for the link budget and 2 for multipath. Keys that are not settings are
/// ignored. Throws Error "FILE:LINE: …" on an invalid or out-of-range value.
std::shared_ptr<const RadioModel> radio_model_from(PropagationModel model,
                                                   const std::vector<RawParameter>& parameters,
                                                   const Location& location,
                                                   Diagnostics& diagnostics);

/// Same, but for a kind of tag called `name`; defaults are those of default_tag_model().
std::shared_ptr<const TagModel> tag_model_from(const std::string& name,
                                               const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics);

}  // namespace tagfield
