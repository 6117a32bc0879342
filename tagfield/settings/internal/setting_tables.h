// SPDX-License-Identifier: Apache-2.0
/// @file
/// All keys of an antenna and of a tag.
#pragma once

#include <vector>

#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/internal/setting.h"

namespace tagfield::settings_internal {

/// An antenna model under construction: its inventory is set by several keys.
struct AntennaDraft {
  RadioModel model;
  Gen2Reader gen2;
  bool takes_inventory = false;
};

const std::vector<Setting<AntennaDraft>>& antenna_table();
const std::vector<Setting<TagModel>>& tag_table();

}  // namespace tagfield::settings_internal
