// SPDX-License-Identifier: Apache-2.0
/// @file
/// Files that options such as --mcap write, and what they may replace.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace tagfield {

struct OutputFile {
  std::string option;              ///< That names it: "--mcap".
  std::string path;                ///< Or "" if it isn't requested.
  std::string kind;                ///< "an MCAP file".
  std::vector<std::string> marks;  ///< Files of this kind have one of them near their beginning.
};

OutputFile mcap_output(const std::string& path);

/// "--force", for commands without a folder for their results.
void add_force_option(CLI::App& command, bool& force);

/// Throws Error if the file would replace one of `inputs` (of a run's folder, its reads), or,
/// unless `force` is set, an existing file of another kind.
void require_replaceable(const OutputFile& output, const std::vector<std::string>& inputs,
                         bool force);

}  // namespace tagfield
