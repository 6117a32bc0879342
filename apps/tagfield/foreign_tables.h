// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and poses as tables, in the project's own format or in third-party ones
/// (docs/datasets.md).
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

/// Whether that is a run's folder with tables.
bool is_run(const std::string& path);

/// Files of tables in the project's own format.
struct TableFiles {
  std::string reads;
  std::string poses;
};

/// The files that read_tables() reads for a table or a run's folder. Throws Error if poses are
/// missing.
TableFiles own_tables(const std::string& command, const std::string& reads,
                      const std::string& poses);

/// Reads tables, with a progress bar. `reads`: a table, a run's folder, with a format also a folder
/// of tables, or any of them in an archive. `poses`: a table, or "" if the antennas' poses are part
/// of the format or the run. `format`: a file, the name of one in profiles/datasets, or "" for the
/// project's own format. Throws Error, beginning with `command`, if poses are missing or given
/// twice.
ReadsAndPoses read_tables(const std::string& command, const std::string& reads,
                          const std::string& poses, const std::string& format);

/// Adds `--format`.
void add_format_option(CLI::App& command, std::string& format);

}  // namespace tagfield
