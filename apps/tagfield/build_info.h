// SPDX-License-Identifier: Apache-2.0
/// @file
/// What this program was built from, and with.
#pragma once

#include <string>
#include <vector>

namespace tagfield {

/// A part of the program that is left out where a library is missing, or by an option of CMake.
struct OptionalPart {
  std::string key;       ///< As in `--version --json`: "ros2".
  std::string is_for;    ///< What one can do with it.
  std::string needs;     ///< What to install, or set, to have it built.
  bool present = false;  ///< Whether it was compiled in.
};

struct BuildInfo {
  std::string version;
  std::string commit;    ///< Twelve digits; "" where the sources were in no repository of git.
  std::string date;      ///< Of that commit: "2026-01-31"; "" likewise.
  bool changed = false;  ///< Whether files differed from that commit.
  std::string compiler;  ///< "GNU 12.2.0".
  std::string kind;      ///< CMAKE_BUILD_TYPE.
  std::string machine;   ///< "x86_64".
  std::vector<OptionalPart> parts;
};

BuildInfo build_info();

}  // namespace tagfield
