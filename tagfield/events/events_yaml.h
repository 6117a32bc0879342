// SPDX-License-Identifier: Apache-2.0
/// @file
/// What events are asked for, as docs/events.md tells to write it.
#pragma once

#include <string>

#include "tagfield/events/events_spec.h"
#include "tagfield/scenario/yaml_map.h"

namespace tagfield {

/// The section `events`. Throws Error "FILE:LINE: …" on what is malformed or not known.
EventsSpec events_spec_of(YamlMap map);

/// Of a file that has that section alone.
EventsSpec read_events_spec(const std::string& path);

}  // namespace tagfield
