// SPDX-License-Identifier: Apache-2.0
/// @file
/// Sources, compiler and options of this build.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// A part of the program that is left out if a library is missing, or by a CMake option.
struct OptionalPart {
  std::string key;       ///< As in `--version --json`: "ros2".
  std::string is_for;    ///< Its purpose.
  std::string needs;     ///< What to install, or set, to build it.
  bool present = false;  ///< Whether it is built in.
};

struct BuildInfo {
  std::string version;
  std::string commit;    ///< Twelve digits; "" if the sources were not in a git repository.
  std::string date;      ///< Of that commit: "2026-01-31"; "" if there is none.
  bool changed = false;  ///< Whether files differed from that commit.
  std::string compiler;  ///< "GNU 12.2.0".
  std::string kind;      ///< CMAKE_BUILD_TYPE.
  std::string machine;   ///< "x86_64".
  std::vector<OptionalPart> parts;
};

BuildInfo build_info();

}  // namespace tagfield
