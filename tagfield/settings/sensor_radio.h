// SPDX-License-Identifier: Apache-2.0
/// @file
/// Physical models as described by an SDF sensor's plugin: the settings in radio_settings.h as
/// elements.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// The model described by an antenna's `model` (default: paper) and its settings; null for the
/// paper's model, in which settings are an error. `frequency` is the carrier and `phase_offset` φ0
/// unless a setting overrides them. Later elements override earlier ones. Throws Error that names
/// the element as in SDF, with its location if known.
std::shared_ptr<const RadioModel> sensor_radio(const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics);

/// The kind of tag described by the settings; null if there are none. Throws Error as above.
std::shared_ptr<const TagModel> sensor_tag_model(const std::vector<RawParameter>& parameters,
                                                 const Location& location,
                                                 Diagnostics& diagnostics);

/// Keys of all settings of an antenna, and of a tag.
std::vector<std::string> antenna_setting_keys();
std::vector<std::string> tag_setting_keys();

}  // namespace tagfield
