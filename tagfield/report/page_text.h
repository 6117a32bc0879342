// SPDX-License-Identifier: Apache-2.0
/// @file
/// The texts of the page: sentences and numbers about a run, as HTML.
#pragma once

#include <string>
#include <vector>

#include "tagfield/report/figures.h"
#include "tagfield/report/summary.h"

namespace tagfield {

/// Title, description, the result in a sentence or two, and a note if the run is incomplete.
std::string page_header(const Summary& summary, const std::optional<TrackedTags>& tracked);

/// The headline numbers.
std::string key_numbers(const Summary& summary);

/// The error of the robot's believed antenna pose, and its effect on the errors; "" if it believed
/// the truth. Plain text.
std::string pose_error_text(const Summary& summary);

/// The results of the same reads with other poses; "" if nothing was compared. Plain text.
std::string compared_pose_text(const Summary& summary);

/// Method, poses, seeds.
std::string run_facts(const Summary& summary);

/// A link with this text that saves `csv` under this name; the data is embedded in the page.
std::string data_link(const std::string& file, const std::string& words, const std::string& csv);

/// One figure with its caption and its data, or the reason why it is missing.
std::string figure_html(const Figure& figure);

/// How to cite the paper.
std::string page_footer();

}  // namespace tagfield
