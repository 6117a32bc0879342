// SPDX-License-Identifier: Apache-2.0
/// @file
/// What a file of any kind that Tagfield knows holds, besides scenarios and worlds.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "tagfield/base/error.h"

namespace tagfield {

/// What a file is, by what it holds: "scenario", "plan", "suite", "sweep", "events", "profile",
/// "dataset format", "calibration" or "map" of YAML files, "world", "recording", "run" (a folder),
/// or "table". Throws Error on what is none of these, with the kinds that there are.
std::string kind_of_file(const std::string& path);

/// Reads a file of a kind other than "scenario", "plan" and "world" as whoever uses it would. Gives
/// what is in it: a mapping from words to numbers, texts and lists of texts, of which `kind` is the
/// first. Throws Error "FILE:LINE: …" on what is wrong.
nlohmann::ordered_json describe_checked_file(const std::string& path, const std::string& kind,
                                             Diagnostics& diagnostics);

}  // namespace tagfield
