// SPDX-License-Identifier: Apache-2.0
/// @file
/// Arguments in a request's body: one JSON object, validated.
#pragma once

#include <Eigen/Core>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace tagfield::http {

/// Extracts the values of a JSON object one by one. All functions throw Error, one line that names
/// the key and the expected value.
class JsonArguments {
 public:
  /// `body`: a JSON object; empty text counts as one without keys.
  explicit JsonArguments(const std::string& body);

  [[nodiscard]] bool has(const std::string& key);
  /// 1 to 1000 bytes without control characters.
  std::string text(const std::string& key);
  /// Finite and from `least` to `most`.
  double number(const std::string& key, double least, double most);
  double number(const std::string& key, double least, double most, double otherwise);
  /// `count` finite numbers within ±`most`.
  std::vector<double> numbers(const std::string& key, std::size_t count, double most);
  /// Throws Error if there are keys that were not requested.
  void finish() const;

 private:
  const nlohmann::json& at(const std::string& key);
  /// The keys that were not requested yet.
  [[nodiscard]] std::vector<std::string> unasked() const;
  /// One of them that differs only in upper and lower case; "" if there is none.
  [[nodiscard]] std::string written_otherwise(const std::string& key) const;

  nlohmann::json values_;
  std::set<std::string> asked_;  ///< The keys that are known here, as far as requested.
};

}  // namespace tagfield::http
