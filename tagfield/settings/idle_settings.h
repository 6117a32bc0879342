// SPDX-License-Identifier: Apache-2.0
/// @file
/// Settings that have no effect in combination with the others given: Q without an inventory, the
/// tilt of a circular polarization. They cause a warning, since whoever gives one expects an
/// effect.
#pragma once

#include <optional>
#include <string>

namespace tagfield {

struct RadioModel;
struct TagModel;

/// Why the antenna's setting `key` (radio_settings.h) has no effect in `model`, such as "without
/// inventory: gen2"; none if it has one, or may have one in some world. Effects disabled by
/// `without` count as present: a user who disables one knows that its settings then have no effect.
std::optional<std::string> why_idle(const std::string& key, const RadioModel& model);

/// Same, but for a tag.
std::optional<std::string> why_idle(const std::string& key, const TagModel& tag);

}  // namespace tagfield
