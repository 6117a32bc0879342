// SPDX-License-Identifier: Apache-2.0
/// @file
/// Physical models as an SDF sensor's plugin describes them: the settings of radio_settings.h as
/// elements.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "tagfield/base/setting.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {

/// What an antenna's `model` (paper where it is not given) and its settings describe; null for the
/// paper's model, beside which a setting is an error. `frequency` is the carrier and `phase_offset`
/// φ0 where no setting says else. Later elements go before earlier ones. Throws Error that names
/// the element as it stands in SDF, with its place where that is known.
std::shared_ptr<const RadioModel> sensor_radio(const std::vector<RawParameter>& parameters,
                                               const Location& location, Diagnostics& diagnostics);

/// What kind of tag the settings describe; null where there is none. Throws likewise.
std::shared_ptr<const TagModel> sensor_tag_model(const std::vector<RawParameter>& parameters,
                                                 const Location& location,
                                                 Diagnostics& diagnostics);

/// Keys of the settings, of an antenna or of a tag.
std::vector<std::string> antenna_setting_keys();
std::vector<std::string> tag_setting_keys();

}  // namespace tagfield
