// SPDX-License-Identifier: Apache-2.0
/// @file
/// Identification of the program that made results, as only the same one may continue them.
#pragma once

#include <string>

namespace tagfield {

/// "0.1.0+1a2b3c4d5e6f": the version and the commit that it was built from, followed by ".changed"
/// if files differed from that; only the version if the sources were not in a git repository.
std::string program_version();

}  // namespace tagfield
