// SPDX-License-Identifier: Apache-2.0
/// @file
/// The report: one HTML page and its figures, made from the files in a run's folder.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

class StagedFolder;
struct RunFiles;

/// A 3D view of the run over time, inserted into the page as is.
struct RunView {
  std::string html;         ///< With a script.
  std::string script_hash;  ///< Of that script, "sha256-…", by which the page allows it to run.
};

/// Makes the view of a run; null, or an empty result, for none.
using MakeView = std::function<std::optional<RunView>(const RunFiles& run)>;

/// Draws report.html and figures/*.svg in a folder with summary.json, reads.csv, antenna_poses.csv
/// and, if the truth is known, truth/ and top_view.json. Figures of an older report are removed.
/// The same files give the same bytes. Throws Error if a required file is missing or malformed;
/// then nothing is replaced.
void write_report(const std::string& run_folder, const MakeView& make_view = {});

/// Same, but from the files in `run_folder`, staged as a part of `folder`.
void stage_report(const std::string& run_folder, const MakeView& make_view, StagedFolder& folder);

/// The beginning of a page up to its body. Its policy forbids fetching anything, and running any
/// but the scripts with these hashes; empty ones are ignored. `title` is escaped here.
std::string page_head(const std::string& title, const std::vector<std::string>& script_hashes = {});

}  // namespace tagfield
