// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/error.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace tagfield {
namespace {

std::string prefixed(const Location& location, const std::string& message) {
  const std::string place = to_string(location);
  return place.empty() ? message : place + ": " + message;
}

constexpr std::size_t kLongestLine = 4000;
/// At least this many similar warnings are merged.
constexpr std::size_t kMany = 3;

/// "FILE:LINE: words" split into its parts; `line` is 0 if the text has another form.
struct Placed {
  std::string file;
  std::string words;  ///< "antennas[].range_m …": without numbers in brackets.
  int line = 0;
};

std::string without_numbers_in_brackets(const std::string& text) {
  std::string words;
  bool inside = false;
  for (const char c : text) {
    const bool is_digit = c >= '0' && c <= '9';
    if (!inside || !is_digit) words += c;
    inside = c == '[' || (inside && is_digit);
  }
  return words;
}

Placed placed(const std::string& warning) {
  for (std::size_t colon = warning.find(':'); colon != std::string::npos;
       colon = warning.find(':', colon + 1)) {
    std::size_t end = colon + 1;
    while (end < warning.size() && warning[end] >= '0' && warning[end] <= '9') ++end;
    const bool is_line = end > colon + 1 && end - colon < 10 && warning.compare(end, 2, ": ") == 0;
    if (!is_line) continue;
    return {warning.substr(0, colon), without_numbers_in_brackets(warning.substr(end + 2)),
            std::stoi(warning.substr(colon + 1, end - colon - 1))};
  }
  return {"", warning, 0};
}

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

std::string escape_of(char c) {
  if (c == '\n') return "\\n";
  if (c == '\t') return "\\t";
  constexpr const char* kDigits = "0123456789abcdef";
  const auto code = static_cast<unsigned char>(c);
  return {'\\', 'x', kDigits[code / 16], kDigits[code % 16]};
}

/// The next start of a UTF-8 character.
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

std::vector<std::string> alike_as_one(const std::vector<std::string>& warnings) {
  struct Alike {
    std::size_t count = 0;
    int last_line = 0;
  };
  std::map<std::pair<std::string, std::string>, Alike> kinds;
  for (const std::string& warning : warnings) {
    const Placed at = placed(warning);
    Alike& alike = kinds[{at.file, at.words}];
    ++alike.count;
    alike.last_line = std::max(alike.last_line, at.line);
  }
  std::vector<std::string> some;
  std::set<std::pair<std::string, std::string>> said;
  for (const std::string& warning : warnings) {
    const Placed at = placed(warning);
    const Alike& alike = kinds[{at.file, at.words}];
    if (at.line == 0 || alike.count < kMany) {
      some.push_back(warning);
    } else if (said.insert({at.file, at.words}).second) {
      some.push_back(warning + " (and " + std::to_string(alike.count - 1) +
                     " more like it, to line " + std::to_string(alike.last_line) + ")");
    }
  }
  return some;
}

}  // namespace tagfield
