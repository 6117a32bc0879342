// SPDX-License-Identifier: Apache-2.0
/// @file
/// JSON from outside, read with a check at each step. Every error message names the file and the
/// path of the value: "summary.json: tags[3].truth_m[0] is a string, expected a number".
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

/// A value and its location.
struct JsonLocation {
  const nlohmann::json* value = nullptr;
  std::string file;
  std::string path;  ///< "" at the top.
};

/// Throws Error "FILE: PATH MESSAGE".
[[noreturn]] void fail_at(const JsonLocation& place, const std::string& message);

/// Throws Error unless `text` is JSON.
nlohmann::json parsed_json(const std::string& text, const std::string& file);

/// A member of an object; throws Error if there is none.
JsonLocation member(const JsonLocation& object, const std::string& key);
bool is_null(const JsonLocation& place);
/// The elements of a list.
std::vector<JsonLocation> elements(const JsonLocation& list);

std::string text_at(const JsonLocation& place);
bool truth_at(const JsonLocation& place);
std::uint64_t whole_at(const JsonLocation& place);
/// A number of plausible size (below 1e15).
double number_at(const JsonLocation& place);
/// [x, y, z].
Eigen::Vector3d point_at(const JsonLocation& place);

}  // namespace tagfield
