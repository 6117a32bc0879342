// SPDX-License-Identifier: Apache-2.0
#include "tagfield/files/json_text.h"

#include <fmt/format.h>

#include <cstddef>
#include <cstdint>

namespace tagfield {
namespace {

/// Number of bytes of the first character of `text`; 0 if it is not valid UTF-8: Unicode Standard,
/// table 3-7.
std::size_t character_length(std::string_view text) {
  const auto byte = [text](std::size_t i) {
    return i < text.size() ? static_cast<std::uint8_t>(text[i]) : std::uint8_t{0};
  };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4) return 0;
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0U) != 0x80U) return 0;
  }
  const bool is_overlong = (first == 0xE0 && byte(1) < 0xA0) || (first == 0xF0 && byte(1) < 0x90);
  const bool is_beyond = (first == 0xED && byte(1) > 0x9F) || (first == 0xF4 && byte(1) > 0x8F);
  return is_overlong || is_beyond ? 0 : length;
}

void append_character(std::string_view character, std::string& json) {
  const char c = character.front();
  if (c == '"' || c == '\\') {
    json += '\\';
    json += c;
  } else if (static_cast<unsigned char>(c) < 0x20) {
    json += fmt::format("\\u{:04x}", static_cast<unsigned>(c));
  } else {
    json += character;
  }
}

}  // namespace

void append_quoted(std::string_view text, std::string& json) {
  json += '"';
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      json += "\xEF\xBF\xBD";
    } else {
      append_character(text.substr(0, length), json);
    }
    text.remove_prefix(length == 0 ? 1 : length);
  }
  json += '"';
}

std::string json_string(std::string_view text) {
  std::string json;
  append_quoted(text, json);
  return json;
}

}  // namespace tagfield
