// SPDX-License-Identifier: Apache-2.0
/// @file
/// The report: one HTML page and its figures, drawn from the files in a run's folder.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

class StagedFolder;
struct RunFiles;

/// What shows the run in three dimensions over time, put into the page as it is.
struct RunView {
  std::string html;         ///< With a script.
  std::string script_hash;  ///< Of that script, "sha256-…": the only one that the page lets run.
};

/// Makes it of a run; null, or nothing made, for none.
using MakeView = std::function<std::optional<RunView>(const RunFiles& run)>;

/// Draws report.html and figures/*.svg in a folder that holds summary.json, reads.csv,
/// antenna_poses.csv and, where the truth is known, truth/ and top_view.json. Figures of an older
/// report vanish. The same files give the same bytes. Throws Error if a file that must be there is
/// missing or malformed; then nothing is replaced.
void write_report(const std::string& run_folder, const MakeView& make_view = {});

/// The same from the files in `run_folder`, as part of what is about to appear in `folder`.
void stage_report(const std::string& run_folder, const MakeView& make_view, StagedFolder& folder);

/// A page from its first byte up to its body: nothing may be fetched, and nothing run but the
/// scripts of these hashes; empty ones are none. `title` is escaped here.
std::string page_head(const std::string& title, const std::vector<std::string>& script_hashes = {});

}  // namespace tagfield
