// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/target.h"

#include <fmt/format.h>

#include <algorithm>

#include "tagfield/base/error.h"
#include "tagfield/base/spelling.h"

namespace tagfield::http {
namespace {

std::optional<int> digit(char c) {
  if (c >= '0' && c <= '9') return c - '0';
  if (c >= 'a' && c <= 'f') return c - 'a' + 10;
  if (c >= 'A' && c <= 'F') return c - 'A' + 10;
  return std::nullopt;
}

std::optional<std::string> unescaped(std::string_view text) {
  std::string out;
  for (std::size_t i = 0; i < text.size(); ++i) {
    char c = text[i];
    if (c == '%') {
      if (i + 2 >= text.size()) return std::nullopt;
      const auto high = digit(text[i + 1]);
      const auto low = digit(text[i + 2]);
      if (!high || !low) return std::nullopt;
      c = static_cast<char>(*high * 16 + *low);
      i += 2;
    }
    if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) return std::nullopt;
    out += c;
  }
  return out;
}

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t end = text.find(by);
    parts.push_back(text.substr(0, end));
    if (end == std::string_view::npos) return parts;
    text.remove_prefix(end + 1);
  }
}

bool add_value(std::string_view pair, Target& target) {
  const std::size_t equals = pair.find('=');
  const auto key = unescaped(pair.substr(0, equals));
  const auto value =
      unescaped(equals == std::string_view::npos ? std::string_view() : pair.substr(equals + 1));
  if (!key || !value) return false;
  target.values[*key] = *value;
  return true;
}

}  // namespace

std::optional<Target> parsed_target(std::string_view text) {
  if (text.empty() || text.front() != '/') return std::nullopt;
  Target target;
  const std::size_t question = text.find('?');
  for (const std::string_view part : split(text.substr(1, question - 1), '/')) {
    const auto plain = unescaped(part);
    if (!plain) return std::nullopt;
    target.parts.push_back(*plain);
  }
  if (question == std::string_view::npos) return target;
  for (const std::string_view pair : split(text.substr(question + 1), '&')) {
    if (!pair.empty() && !add_value(pair, target)) return std::nullopt;
  }
  return target;
}

void require_known(const Target& target, const std::vector<std::string>& known) {
  for (const auto& [key, value] : target.values) {
    if (std::find(known.begin(), known.end(), key) != known.end()) continue;
    throw Error(fmt::format("'?{}' is not a parameter here{}", key,
                            known.empty() ? ": expected none" : suggestion(key, known)));
  }
}

bool matches(const Target& target, std::string_view pattern) {
  const std::vector<std::string_view> wanted = split(pattern.substr(1), '/');
  return std::equal(wanted.begin(), wanted.end(), target.parts.begin(), target.parts.end(),
                    [](std::string_view want, const std::string& part) {
                      return want.front() == '{' ? !part.empty() : want == part;
                    });
}

}  // namespace tagfield::http
