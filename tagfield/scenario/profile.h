/// @file
/// Readers, antennas and tags as data files: profiles/.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/raw_parameter.h"

namespace tagfield {

enum class ProfileKind { kReader, kAntenna, kTag };

struct Profile {
  std::string name;
  ProfileKind kind = ProfileKind::kReader;
  std::vector<RawParameter> parameters;  ///< Keys of tagfield/reader/radio_settings.h.
};

/// Reads a YAML file with `name`, `kind` (reader, antenna, tag) and `figures`: a mapping from keys
/// to {value, source}. Throws Error "FILE:LINE: …" on a key that is no setting of that kind, or a
/// figure without a source.
Profile read_profile(const std::string& path);

}  // namespace tagfield
