// SPDX-License-Identifier: Apache-2.0
/// @file
/// Readers, antennas and tags as data files: profiles/.
#pragma once

#include <string>
#include <vector>

#include "tagfield/base/setting.h"

namespace tagfield {

enum class ProfileKind { kReader, kAntenna, kTag };

struct Profile {
  std::string name;
  ProfileKind kind = ProfileKind::kReader;
  std::vector<RawParameter> parameters;  ///< Keys of tagfield/settings/radio_settings.h.
};

/// Reads a YAML file with `name`, `kind` (reader, antenna, tag) and `figures`: a mapping from keys
/// to {value, source}. Throws Error "FILE:LINE: …" on a key that is not a setting of that kind, or
/// a figure without a source.
Profile read_profile(const std::string& path);

/// Names of the shipped profiles of this kind.
std::vector<std::string> shipped_profiles(ProfileKind kind);

/// The file of the shipped profile of that name and one of `kinds`; "" if there is none.
std::string shipped_profile(const std::string& name, const std::vector<ProfileKind>& kinds);

}  // namespace tagfield
