// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and poses as tables, in the project's own form or in other people's (docs/datasets.md).
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

#include "tagfield/poses/trajectory.h"
#include "tagfield/stream/tag_read.h"

namespace tagfield {

struct ReadsAndPoses {
  std::vector<TagRead> reads;
  std::vector<AntennaPose> poses;
};

/// Whether that is the folder of a run, with its tables.
bool is_run(const std::string& path);

/// Files of tables in the project's own form.
struct TableFiles {
  std::string reads;
  std::string poses;
};

/// Those that read_tables() reads, of a table or the folder of a run. Throws Error where poses are
/// missing.
TableFiles own_tables(const std::string& command, const std::string& reads,
                      const std::string& poses);

/// `reads`: a table, the folder of a run, or with a format a folder of tables too, or any of them
/// in an archive. `poses`: a table, or "" where the format or the run has the antennas' places.
/// `format`: a file, the name of one in profiles/datasets, or "" for the project's own form. Throws
/// Error where poses are missing or one too many; `command` begins that line. With a progress bar.
ReadsAndPoses read_tables(const std::string& command, const std::string& reads,
                          const std::string& poses, const std::string& format);

/// Adds `--format`.
void add_format_option(CLI::App& command, std::string& format);

}  // namespace tagfield
