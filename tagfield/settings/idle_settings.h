// SPDX-License-Identifier: Apache-2.0
/// @file
/// Settings that change nothing beside the others that were given: Q without an inventory, the tilt
/// of a circular polarization. Whoever gives one expects something of it, and is told.
#pragma once

#include <optional>
#include <string>

namespace tagfield {

struct RadioModel;
struct TagModel;

/// Why the antenna's setting `key` (radio_settings.h) changes nothing in `model`, such as "without
/// inventory: gen2"; none where it does, or may do so in some world. Effects that `without` leaves
/// out count as there: whoever leaves one out knows that its settings then are without effect.
std::optional<std::string> why_idle(const std::string& key, const RadioModel& model);

/// Likewise of a tag.
std::optional<std::string> why_idle(const std::string& key, const TagModel& tag);

}  // namespace tagfield
