// SPDX-License-Identifier: Apache-2.0
/// @file
/// YAML mappings read with care: every value is checked, every complaint names file and line, and
/// keys that nobody asked for are errors.
#pragma once

#include <yaml-cpp/yaml.h>

#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "tagfield/base/error.h"

namespace tagfield {

/// What a number may be.
enum class NumberRange { kAny, kNotNegative, kPositive };
inline constexpr NumberRange kPositive = NumberRange::kPositive;
inline constexpr NumberRange kNotNegative = NumberRange::kNotNegative;

/// A value somewhere in a YAML file: where it stands and what its path is ("antennas[0].pose").
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

  /// Finite number within `range` and ±1e15, or ±1e5 where the key ends in `_m`.
  [[nodiscard]] double number(NumberRange range = NumberRange::kAny) const;
  [[nodiscard]] std::uint64_t whole_number() const;
  [[nodiscard]] bool boolean() const;
  /// Text that is not empty, without NUL.
  [[nodiscard]] std::string text() const;
  /// List of at least `least` and at most `most` finite numbers.
  [[nodiscard]] std::vector<double> numbers(
      std::size_t least, std::size_t most = std::numeric_limits<std::size_t>::max()) const;
  /// The same of places, sizes and angles: each within ±1e5.
  [[nodiscard]] std::vector<double> lengths(std::size_t least, std::size_t most) const;
  /// Throws Error unless it is within ±1e5.
  void require_length(double length_m) const;
  [[nodiscard]] std::vector<YamlValue> list() const;

 private:
  YAML::Node node_;
  std::string file_;
  std::string path_;
};

/// A mapping whose keys are taken one by one; finish() complains of those left over.
class YamlMap {
 public:
  explicit YamlMap(YamlValue value);

  [[nodiscard]] bool has(const std::string& key);
  /// The value under `key`; throws Error if there is none.
  YamlValue at(const std::string& key);
  [[nodiscard]] const YamlValue& self() const { return self_; }

  // The value under `key`, or `otherwise`.
  double number(const std::string& key, double otherwise, NumberRange range = NumberRange::kAny);
  std::string text(const std::string& key, const std::string& otherwise);
  bool boolean(const std::string& key, bool otherwise);
  std::vector<YamlValue> list(const std::string& key);

  /// Throws Error if a key that was not asked for yet looks like a slip of `missing`.
  void complain_of_slip(const std::string& missing) const;
  /// Throws Error naming the first key that was never asked for and the nearest one that was.
  void finish() const;

 private:
  [[nodiscard]] bool is_known(const std::string& key) const;
  [[noreturn]] void fail_on_unknown(const YAML::Node& key, const YAML::Node& value,
                                    const std::vector<std::string>& known) const;

  YamlValue self_;
  std::vector<std::string> known_;
};

/// Reads a file that holds one mapping. Throws Error "FILE:LINE: …" if it is missing or malformed.
YAML::Node read_yaml(const std::string& path);
/// Likewise of text that is there already; complaints call it `path`.
YAML::Node yaml_in(const std::string& text, const std::string& path);

/// Puts `value` (YAML text) under `key_path` ("pose.sigma_m", "antennas.0.range_m", or with a
/// list's element by its name or id: "antennas.mobile.range_m"; with a pattern all whose name or id
/// matches: "antennas.port_*.range_m", see base/wildcard.h). Throws Error where that leads nowhere.
void set_in_yaml(const YAML::Node& root, std::string_view key_path, const std::string& value);

}  // namespace tagfield
