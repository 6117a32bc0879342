// SPDX-License-Identifier: Apache-2.0
/// @file
/// The page in words: sentences and numbers about a run, as HTML.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// Title, description, what came out in a sentence or two, and that the run is incomplete.
std::string page_header(const Summary& summary, const std::optional<TrackedTags>& tracked);

/// The big numbers.
std::string key_numbers(const Summary& summary);

/// How far off the robot believed its antenna, and what that does to the errors; "" where it
/// believed the truth. Plain text.
std::string pose_error_text(const Summary& summary);

/// What the same reads give with other poses; "" where nothing was compared. Plain text.
std::string compared_pose_text(const Summary& summary);

/// Method, poses, seeds.
std::string run_facts(const Summary& summary);

/// A link with these words that saves `csv` under this name; the page itself holds what it saves.
std::string data_link(const std::string& file, const std::string& words, const std::string& csv);

/// One figure with its caption and its data, or the words why it is missing.
std::string figure_html(const Figure& figure);

/// How to cite the paper.
std::string page_footer();

}  // namespace tagfield
