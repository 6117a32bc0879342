// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/internal/exact_json.h"

#include <cmath>
#include <limits>
#include <string>

namespace tagfield {

nlohmann::json exact_json(double value) {
  if (std::isfinite(value)) return value;
  return std::isnan(value) ? "nan" : value > 0.0 ? "inf" : "-inf";
}

double exact_double_in(const nlohmann::json& json) {
  if (json.is_number()) return json.get<double>();
  const auto word = json.get<std::string>();
  if (word == "inf") return std::numeric_limits<double>::infinity();
  if (word == "-inf") return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

nlohmann::json exact_json(const std::optional<double>& value) {
  return value ? exact_json(*value) : nlohmann::json();
}

std::optional<double> exact_optional_in(const nlohmann::json& json) {
  if (json.is_null()) return std::nullopt;
  return exact_double_in(json);
}

nlohmann::json exact_json(const std::optional<Eigen::Vector3d>& p) {
  if (!p) return nullptr;
  return nlohmann::json::array({exact_json(p->x()), exact_json(p->y()), exact_json(p->z())});
}

std::optional<Eigen::Vector3d> exact_place_in(const nlohmann::json& json) {
  if (json.is_null()) return std::nullopt;
  return Eigen::Vector3d(exact_double_in(json.at(0)), exact_double_in(json.at(1)),
                         exact_double_in(json.at(2)));
}

std::string one_line_of(const nlohmann::json& json) {
  return json.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tagfield
