// SPDX-License-Identifier: Apache-2.0
/// @file
/// The data of a figure as CSV, which can be saved from the page.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <optional>
#include <string>

#include "tagfield/files/csv.h"

namespace tagfield {

/// The value with seven digits; "" if it is not finite.
inline std::string data_cell(double value) {
  return std::isfinite(value) ? fmt::format("{:.7g}", value) : "";
}
inline std::string data_cell(std::size_t value) { return fmt::format("{}", value); }
inline std::string data_cell(const std::string& text) { return csv_field(text); }
inline std::string data_cell(const char* text) { return csv_field(text); }
inline std::string data_cell(const std::optional<double>& value) {
  return value ? data_cell(*value) : "";
}

/// Appends a row of numbers and texts.
template <typename First, typename... Others>
void add_data(std::string& csv, const First& first, const Others&... others) {
  csv += data_cell(first);
  ((csv += ',', csv += data_cell(others)), ...);
  csv += '\n';
}

}  // namespace tagfield
