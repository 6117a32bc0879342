// SPDX-License-Identifier: Apache-2.0
/// @file
/// Specification of events in YAML; see docs/events.md for the format.
#pragma once

#include <string>

#include "tagfield/events/events_spec.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// Parses the section `events`. Throws Error "FILE:LINE: …" on malformed or unknown content.
EventsSpec events_spec_of(YamlMap map);

/// Reads a file that contains only that section.
EventsSpec read_events_spec(const std::string& path);

}  // namespace tagfield
