// SPDX-License-Identifier: Apache-2.0
#include "apps/tagfield/program_version.h"

#include "build_commit.h"

namespace tagfield {

std::string program_version() {
  std::string version = TAGFIELD_VERSION;
  if (*kCommit != '\0') version += std::string("+") + kCommit;
  if (kChangedSinceCommit) version += ".changed";
  return version;
}

}  // namespace tagfield
