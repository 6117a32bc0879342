// SPDX-License-Identifier: Apache-2.0
/// @file
/// Strict reading of YAML mappings: every value is checked, every error message names file and
/// line, and keys that are never read are errors.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// Allowed range of a number.
enum class NumberRange { kAny, kNotNegative, kPositive };
inline constexpr NumberRange kPositive = NumberRange::kPositive;
inline constexpr NumberRange kNotNegative = NumberRange::kNotNegative;

/// A value in a YAML file, with its location and its path ("antennas[0].pose").
class YamlValue {
 public:
  YamlValue(const YAML::Node& node, std::string file, std::string path)
      : node_(node), file_(std::move(file)), path_(std::move(path)) {}

  /// Throws Error "FILE:LINE: PATH MESSAGE".
  [[noreturn]] void fail(const std::string& message) const;
  [[nodiscard]] Location location() const;
  [[nodiscard]] const YAML::Node& node() const { return node_; }
  [[nodiscard]] const std::string& file() const { return file_; }
  [[nodiscard]] const std::string& path() const { return path_; }

  /// Finite number within `range` and ±1e15, or ±1e5 if the key ends in `_m`.
  [[nodiscard]] double number(NumberRange range = NumberRange::kAny) const;
  [[nodiscard]] std::uint64_t whole_number() const;
  [[nodiscard]] bool boolean() const;
  /// Text that is not empty, without NUL.
  [[nodiscard]] std::string text() const;
  /// List of at least `least` and at most `most` finite numbers.
  [[nodiscard]] std::vector<double> numbers(
      std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// Same, but for positions, sizes and angles: each within ±1e5.
  [[nodiscard]] std::vector<double> lengths(std::size_t least, std::size_t most) const;
  /// Throws Error unless it is within ±1e5.
  void require_length(double length_m) const;
  [[nodiscard]] std::vector<YamlValue> list() const;

 private:
  YAML::Node node_;
  std::string file_;
  std::string path_;
};

/// A mapping whose keys are read one by one; finish() reports those left over.
class YamlMap {
 public:
  explicit YamlMap(YamlValue value);

  [[nodiscard]] bool has(const std::string& key);
  /// The value under `key`; throws Error if there is none, which says what was expected if
  /// `expected` does.
  YamlValue at(const std::string& key, std::string_view expected = "");
  [[nodiscard]] const YamlValue& self() const { return self_; }

  // The value under `key`, or `otherwise`.
  double number(const std::string& key, double otherwise, NumberRange range = NumberRange::kAny);
  std::string text(const std::string& key, const std::string& otherwise);
  bool boolean(const std::string& key, bool otherwise);
  std::vector<YamlValue> list(const std::string& key);

  /// Throws Error if a key that was not read yet looks like a typo of `missing`.
  void complain_of_slip(const std::string& missing) const;
  /// Throws Error naming the first key that was never read and the most similar known one.
  void finish() const;

 private:
  [[nodiscard]] bool is_known(const std::string& key) const;
  [[noreturn]] void fail_on_unknown(const YAML::Node& key, const YAML::Node& value,
                                    const std::vector<std::string>& known) const;

  YamlValue self_;
  std::vector<std::string> known_;
};

/// Reads a file that contains one mapping. Throws Error "FILE:LINE: …" if it is missing or
/// malformed.
YAML::Node read_yaml(const std::string& path);
/// Same, but from text; error messages call it `path`.
YAML::Node yaml_in(const std::string& text, const std::string& path);

/// Sets `key_path` to `value` (YAML text). Examples: "pose.sigma_m"; "antennas.0.range_m", or with
/// the name or ID of a list's element "antennas.mobile.range_m"; with a pattern, all elements whose
/// name or ID matches: "antennas.port_*.range_m" (see base/wildcard.h). Throws Error if the path
/// leads nowhere.
void set_in_yaml(const YAML::Node& root, std::string_view key_path, const std::string& value);

}  // namespace tagfield
