// SPDX-License-Identifier: Apache-2.0
/// @file
/// JSON from outside, read with a check at each step. Every complaint names the file and the path
/// of the value: "summary.json: tags[3].truth_m[0] is a string, expected a number".
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tagfield {

/// A value and where it stands.
struct JsonPlace {
  const nlohmann::json* value = nullptr;
  std::string file;
  std::string path;  ///< "" at the top.
};

/// Throws Error "FILE: PATH MESSAGE".
[[noreturn]] void fail_at(const JsonPlace& place, const std::string& message);

/// Throws Error unless `text` is JSON.
nlohmann::json parsed_json(const std::string& text, const std::string& file);

/// A member of an object; throws Error if there is none.
JsonPlace member(const JsonPlace& object, const std::string& key);
bool is_null(const JsonPlace& place);
/// The elements of a list.
std::vector<JsonPlace> elements(const JsonPlace& list);

std::string text_at(const JsonPlace& place);
bool truth_at(const JsonPlace& place);
std::uint64_t whole_at(const JsonPlace& place);
/// A number of a size that a run can have (below 1e15).
double number_at(const JsonPlace& place);
/// [x, y, z].
Eigen::Vector3d point_at(const JsonPlace& place);

}  // namespace tagfield
