// SPDX-License-Identifier: Apache-2.0
/// @file
/// Values as JSON that are read back bit for bit.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>

namespace tagfield {

/// A number; infinity and NaN, which JSON lacks, become strings.
nlohmann::json exact_json(double value);
double exact_double_in(const nlohmann::json& json);

/// Null for none.
nlohmann::json exact_json(const std::optional<double>& value);
std::optional<double> exact_optional_in(const nlohmann::json& json);

/// A list of three numbers; null for none.
nlohmann::json exact_json(const std::optional<Eigen::Vector3d>& p);
std::optional<Eigen::Vector3d> exact_place_in(const nlohmann::json& json);

/// The JSON on one line; bytes that are not UTF-8 become U+FFFD.
std::string one_line_of(const nlohmann::json& json);

}  // namespace tagfield
