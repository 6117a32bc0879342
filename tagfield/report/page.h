/// @file
/// The report: one HTML page and its figures, drawn from the files in a run's folder.
#pragma once

#include <string>

namespace tagfield {

class StagedFolder;

/// Draws report.html and figures/*.svg in a folder that holds summary.json, reads.csv,
/// antenna_poses.csv and, where the truth is known, truth/ and top_view.json. Figures of an older
/// report vanish. The same files give the same bytes. Throws Error if a file that must be there is
/// missing or malformed; then nothing is replaced.
void write_report(const std::string& run_folder);

/// The same from the files in `run_folder`, as part of what is about to appear in `folder`.
void stage_report(const std::string& run_folder, StagedFolder& folder);

/// A page from its first byte up to its body: nothing may be fetched or run. `title` is escaped
/// here.
std::string page_head(const std::string& title);

}  // namespace tagfield
