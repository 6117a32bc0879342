// SPDX-License-Identifier: Apache-2.0
/// @file
/// The kinds of results other than tables: JSON, databases, pages, and folders of all commands.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// Whether this is the database of a sweep, and not one of rosbag2.
bool is_sweep_database(const std::string& path);
/// Whether a folder has results of a command other than 'run' and 'localize'.
bool is_result_folder(const std::string& path);
/// Whether a file's name ends as those of results do that are neither tables nor databases.
bool is_result_name(const std::string& path);

/// Contents of such a file, a database of a sweep or a folder, in the form of
/// describe_checked_file(). All known tables and JSON files of a folder are checked. Throws Error
/// "FILE:LINE: …" on what is damaged, and on JSON whose keys are of no kind.
nlohmann::ordered_json describe_result(const std::string& path);

}  // namespace tagfield
