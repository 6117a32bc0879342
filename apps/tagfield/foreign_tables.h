// SPDX-License-Identifier: Apache-2.0
/// @file
/// Reads and poses as tables, in the project's own format or in third-party ones
/// (docs/datasets.md).
#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
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

/// Where a command finds reads and poses.
struct TableSources {
  std::string command;  ///< With which error messages begin.
  /// A table, a run's folder, with a format also a folder of tables, or any of them in an archive.
  std::string reads;
  std::string poses;  ///< A table, or "" if they are part of the format or the run.
  std::string
      format;  ///< A file, the name of one in profiles/datasets, or "" for the project's own.
  bool needs_poses = true;
};

/// Reads tables, with a progress bar. Warns of carriers and phases in the wrong unit. Throws Error
/// if poses are missing or given twice. Without `needs_poses` they are empty if there are none.
ReadsAndPoses read_tables(const TableSources& sources, Diagnostics& diagnostics);

/// Calls `use` with the only table or folder of tables in the archive, unpacked for as long as that
/// takes; or with `path` itself, if it is not an archive. Errors and warnings name `path`.
void use_tables(const std::string& path, Diagnostics& diagnostics,
                const std::function<void(const std::string& tables, Diagnostics& of_tables)>& use);

/// Adds `--format`.
void add_format_option(CLI::App& command, std::string& format);

}  // namespace tagfield
