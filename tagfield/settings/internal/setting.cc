#include "tagfield/settings/internal/setting.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>

#include "tagfield/base/error.h"
#include "tagfield/base/number.h"

namespace tagfield::settings_internal {

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

}  // namespace tagfield::settings_internal
