// SPDX-License-Identifier: Apache-2.0
/// @file
/// Descriptions of files of all kinds that Tagfield supports, except for scenarios and worlds.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

struct CheckedFile {
  std::string path;
  std::string poses;   ///< Of the antennas of a table of reads, or "".
  std::string format;  ///< Of tables from other sources, or "".
};

/// The kind of a file, according to its contents: "scenario", "plan", "suite", "sweep", "events",
/// "profile", "dataset format", "calibration" or "map" for YAML files, "world", "recording", "run"
/// (a folder), "table", also in an archive or with a format, or "result", which is any other file
/// or folder that a command writes. Throws Error, which lists the kinds, if it is none of these.
std::string kind_of_file(const CheckedFile& file);

/// Reads a file of a kind other than "scenario", "plan" and "world" just as the commands that use
/// it, with the warnings of those, such as of phases in another unit. Returns its contents: a
/// mapping from words to numbers, texts and lists of texts, whose first entry is `kind`. Throws
/// Error "FILE:LINE: …" on invalid input, and if poses are given with anything but reads.
nlohmann::ordered_json describe_checked_file(const CheckedFile& file, const std::string& kind,
                                             Diagnostics& diagnostics);

}  // namespace tagfield
