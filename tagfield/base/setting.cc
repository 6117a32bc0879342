// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "tagfield/base/error.h"
#include "tagfield/base/number.h"
#include "tagfield/base/range_check.h"

namespace tagfield {

double number_in(const std::string& text) {
  const std::optional<double> value = parse_number(text);
  if (!value || !std::isfinite(*value)) {
    throw Error(fmt::format("is '{}', expected a finite number", text));
  }
  return *value;
}

int whole_in(const std::string& text) {
  const double value = number_in(text);
  if (std::floor(value) != value || std::abs(value) > 1e9) {
    throw Error(fmt::format("is '{}', expected a whole number", text));
  }
  return static_cast<int>(value);
}

bool truth_in(const std::string& text) {
  if (text == "true" || text == "1") return true;
  if (text == "false" || text == "0") return false;
  throw Error(fmt::format("is '{}', expected true or false", text));
}

std::vector<std::string> words_in(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> words;
  for (std::string word; stream >> word;) words.push_back(word);
  return words;
}

std::vector<double> numbers_in(const std::string& text) {
  std::vector<double> numbers;
  for (const std::string& word : words_in(text)) numbers.push_back(number_in(word));
  return numbers;
}

std::size_t choice_in(const std::string& text, const std::vector<std::string>& choices) {
  const auto found = std::find(choices.begin(), choices.end(), text);
  if (found == choices.end()) {
    throw Error(fmt::format("is '{}', expected {}", text, fmt::join(choices, ", ")));
  }
  return static_cast<std::size_t>(found - choices.begin());
}

std::string one_of(const std::vector<std::string>& choices) {
  return fmt::format("{}", fmt::join(choices, " | "));
}

ValueRange limited(ValueRange range, const std::string& unit) {
  if (unit == "m") range.most = std::min(range.most, kMaxLength_m);
  return range;
}

std::string to_string(const ValueRange& range) {
  const std::string least = fmt::format("{} {:g}", range.over ? "over" : "at least", range.least);
  return range.most == ValueRange{}.most ? least
                                         : fmt::format("{} and at most {:g}", least, range.most);
}

double number_in(const std::string& text, const ValueRange& range) {
  const double value = number_in(text);
  const bool enough = range.over ? value > range.least : value >= range.least;
  if (enough && value <= range.most) return value;
  throw Error(fmt::format("must be {}, is {}",
                          enough ? fmt::format("at most {:g}", range.most) : to_string(range),
                          text));
}

double whole_number_in(const std::string& text, const ValueRange& range) {
  const double value = number_in(text, range);
  if (std::floor(value) != value) {
    throw Error(fmt::format("is '{}', expected a whole number", text));
  }
  return value;
}

std::string text_of(double number) { return fmt::format("{}", number); }

bool has_key(const std::vector<SettingHelp>& helps, const std::string& key) {
  return std::any_of(helps.begin(), helps.end(),
                     [&](const SettingHelp& help) { return help.key == key; });
}

Location place_of(const std::string& complaint, const std::vector<RawParameter>& parameters,
                  const Location& otherwise) {
  const std::string key = complaint.substr(0, complaint.find(' '));
  const auto found = std::find_if(parameters.rbegin(), parameters.rend(),
                                  [&](const RawParameter& p) { return p.key == key; });
  return found == parameters.rend() ? otherwise : found->location;
}

}  // namespace tagfield
