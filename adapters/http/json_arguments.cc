// SPDX-License-Identifier: Apache-2.0
#include "adapters/http/json_arguments.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <utility>

#include "tagfield/base/error.h"
#include "tagfield/base/spelling.h"

namespace tagfield::http {
namespace {

constexpr std::size_t kMaxText = 1000;

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }

double finite_within(const nlohmann::json& value, double least, double most,
                     const std::string& what) {
  if (!value.is_number()) throw Error(fmt::format("{} must be a number", what));
  const auto number = value.get<double>();
  if (!(number >= least && number <= most)) {
    throw Error(fmt::format("{} must be from {:g} to {:g}, is {:g}", what, least, most, number));
  }
  return number;
}

/// Watches the keys while JSON is parsed: of two values with one key only the last would be left.
class KeyWatch {
 public:
  bool operator()(int /*depth*/, nlohmann::json::parse_event_t event, nlohmann::json& parsed) {
    using Event = nlohmann::json::parse_event_t;
    if (event == Event::object_start) open_.emplace_back();
    if (event == Event::object_end && !open_.empty()) open_.pop_back();
    if (event == Event::key && !open_.empty()) {
      auto key = parsed.get<std::string>();
      if (!open_.back().insert(key).second) repeated_ = std::move(key);
    }
    return true;
  }
  [[nodiscard]] const std::optional<std::string>& repeated() const { return repeated_; }

 private:
  std::vector<std::set<std::string>> open_;  ///< Keys of the objects around.
  std::optional<std::string> repeated_;
};

}  // namespace

JsonArguments::JsonArguments(const std::string& body) : values_(nlohmann::json::object()) {
  if (body.empty()) return;
  KeyWatch keys;
  values_ = nlohmann::json::parse(body, std::ref(keys), false);
  if (values_.is_discarded()) throw Error("the body is not JSON");
  if (keys.repeated()) throw Error(fmt::format("'{}' is given twice", *keys.repeated()));
  if (!values_.is_object()) throw Error("the body must be a JSON object");
}

std::vector<std::string> JsonArguments::unasked() const {
  std::vector<std::string> keys;
  for (const auto& [key, value] : values_.items()) {
    if (asked_.count(key) == 0) keys.push_back(key);
  }
  return keys;
}

std::string JsonArguments::written_otherwise(const std::string& key) const {
  const auto lower = [](char c) { return std::tolower(static_cast<unsigned char>(c)); };
  const auto is_same = [&](char a, char b) { return lower(a) == lower(b); };
  for (const std::string& other : unasked()) {
    if (std::equal(key.begin(), key.end(), other.begin(), other.end(), is_same)) return other;
  }
  return "";
}

bool JsonArguments::has(const std::string& key) {
  asked_.insert(key);
  return values_.contains(key);
}

const nlohmann::json& JsonArguments::at(const std::string& key) {
  asked_.insert(key);
  const auto found = values_.find(key);
  if (found == values_.end()) {
    // Short names of different values resemble each other: x, y.
    const std::string near = key.size() < 4 ? written_otherwise(key) : nearest_word(key, unasked());
    throw Error(near.empty()
                    ? fmt::format("'{}' is missing", key)
                    : fmt::format("'{}' is missing (did you mean it by '{}'?)", key, near));
  }
  return *found;
}

std::string JsonArguments::text(const std::string& key) {
  const nlohmann::json& value = at(key);
  if (!value.is_string()) throw Error(fmt::format("'{}' must be text", key));
  auto text = value.get<std::string>();
  if (text.empty() || text.size() > kMaxText || std::any_of(text.begin(), text.end(), is_control)) {
    throw Error(
        fmt::format("'{}' must have 1 to {} bytes without control characters", key, kMaxText));
  }
  return text;
}

double JsonArguments::number(const std::string& key, double least, double most) {
  return finite_within(at(key), least, most, "'" + key + "'");
}

double JsonArguments::number(const std::string& key, double least, double most, double otherwise) {
  return has(key) ? number(key, least, most) : otherwise;
}

std::vector<double> JsonArguments::numbers(const std::string& key, std::size_t count, double most) {
  const nlohmann::json& value = at(key);
  if (!value.is_array() || value.size() != count) {
    throw Error(fmt::format("'{}' must be a list of {} numbers", key, count));
  }
  std::vector<double> numbers;
  for (const nlohmann::json& entry : value) {
    numbers.push_back(finite_within(entry, -most, most, "each number of '" + key + "'"));
  }
  return numbers;
}

void JsonArguments::finish() const {
  const std::vector<std::string> unknown = unasked();
  if (unknown.empty()) return;
  const std::string& key = unknown.front();
  const std::string near = nearest_word(key, {asked_.begin(), asked_.end()});
  throw Error(fmt::format("'{}' is not known here{}", key,
                          near.empty() ? "" : fmt::format(" (did you mean '{}'?)", near)));
}

}  // namespace tagfield::http
