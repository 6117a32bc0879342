#include "tagfield/base/error.h"

#include <algorithm>
#include <utility>

namespace tagfield {
namespace {

std::string prefixed(const Location& location, const std::string& message) {
  const std::string place = to_string(location);
  return place.empty() ? message : place + ": " + message;
}

constexpr std::size_t kLongestLine = 4000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

std::string escape_of(char c) {
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  constexpr const char* kDigits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[code / 16], kDigits[code % 16]};
}

/// Not in the middle of a UTF-8 character.
std::size_t character_from(const std::string& text, std::size_t at) {
  while (at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U) ++at;
  return at;
}

}  // namespace

std::string as_one_line(const std::string& message) {
  std::string line;
  line.reserve(message.size());
  for (const char c : message) {
    if (is_control(c)) {
      line += escape_of(c);
    } else {
      line += c;
    }
  }
  if (line.size() <= kLongestLine) return line;
  const std::size_t begin = character_from(line, kLongestLine / 2);
  const std::size_t end = character_from(line, line.size() - kLongestLine / 2);
  return line.substr(0, begin) + " … " + line.substr(end);
}

std::string to_string(const Location& location) {
  if (location.file.empty() || location.line <= 0) return location.file;
  return location.file + ":" + std::to_string(location.line);
}

void fail(const Location& location, const std::string& message) {
  throw Error(prefixed(location, message));
}

void Diagnostics::warn(const std::string& message) {
  std::string line = as_one_line(message);
  if (std::find(warnings_.begin(), warnings_.end(), line) == warnings_.end()) {
    warnings_.push_back(std::move(line));
  }
}

void Diagnostics::warn(const Location& location, const std::string& message) {
  warn(prefixed(location, message));
}

}  // namespace tagfield
