// SPDX-License-Identifier: Apache-2.0
/// @file
/// Which program made results that may only be continued by the same.
#pragma once

#include <string>

namespace tagfield {

/// "0.1.0+1a2b3c4d5e6f": the version and the commit it was built from, with ".changed" after it
/// where files differed from that; the version alone where the sources were in no repository of
/// git.
std::string program_version();

}  // namespace tagfield
