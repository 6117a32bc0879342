// SPDX-License-Identifier: Apache-2.0
/// @file
/// Parsing of a request's target.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tagfield::http {

/// "/api/tags/tag%201/move?to=x" as {"api", "tags", "tag 1", "move"} and {"to": "x"}.
struct Target {
  std::vector<std::string> parts;
  std::map<std::string, std::string> values;

  [[nodiscard]] std::optional<std::string> query(const std::string& key) const {
    const auto found = values.find(key);
    if (found == values.end()) return std::nullopt;
    return found->second;
  }
};

/// None if it does not begin with '/' or has a broken escape or an escaped control character.
std::optional<Target> parsed_target(std::string_view target);

/// Throws Error, one line that names it, if the query has a parameter other than `known`.
void require_known(const Target& target, const std::vector<std::string>& known);

/// Whether the parts match `pattern`, in which "{…}" stands for any one part.
bool matches(const Target& target, std::string_view pattern);

}  // namespace tagfield::http
