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

/// Which model an antenna is simulated by.
enum class PropagationModel { kPaper, kLinkBudget, kMultipath };

/// "paper", "link_budget" or "multipath". Throws Error on another word.
PropagationModel propagation_model(const RawParameter& parameter);
const char* to_string(PropagationModel model);

/// Those of an antenna, and of a tag.
const std::vector<SettingHelp>& antenna_settings();
const std::vector<SettingHelp>& tag_settings();

/// Whether antenna_settings() (tag_settings()) has it.
bool is_antenna_setting(const std::string& key);
bool is_tag_setting(const std::string& key);

/// The last of the parameters with that key, which counts; null where there is none.
const RawParameter* last_of(const std::vector<RawParameter>& parameters, const std::string& key);

/// The model that `parameters` describe, later ones going before earlier ones of the same key; what
/// is not told is RadioModel's default, with a patch of 8 dBi and 65° right-circular, order 0 by
/// the link budget and 2 by multipath. Keys that are no settings are passed over. Throws Error
/// "FILE:LINE: …" on a value that is none or out of its range.
std::shared_ptr<const RadioModel> radio_model_from(PropagationModel model,
                                                   const std::vector<RawParameter>& parameters,
                                                   const Location& location,
                                                   Diagnostics& diagnostics);

/// Likewise for a kind of tag called `name`, default_tag_model() where nothing is told.
std::shared_ptr<const TagModel> tag_model_from(const std::string& name,
                                               const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics);

}  // namespace tagfield
