// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/internal/checked_json.h"

#include <fmt/format.h>

#include <cmath>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

constexpr double kGreatest = 1e15;

void require(bool condition, const JsonLocation& place, const char* expected) {
  if (condition) return;
  fail_at(place, fmt::format("is {}, expected {}",
                             place.value->is_null() ? "null" : place.value->type_name(), expected));
}

}  // namespace

void fail_at(const JsonLocation& place, const std::string& message) {
  fail({place.file, 0}, (place.path.empty() ? "the file" : place.path) + " " + message);
}

nlohmann::json parsed_json(const std::string& text, const std::string& file) {
  try {
    return nlohmann::json::parse(text);
  } catch (const nlohmann::json::parse_error& error) {
    fail({file, 0}, fmt::format("is not JSON (byte {})", error.byte));
  } catch (const nlohmann::json::exception&) {
    fail({file, 0}, "is not JSON (a number is too great)");
  }
}

JsonLocation member(const JsonLocation& object, const std::string& key) {
  require(object.value->is_object(), object, "an object");
  const auto found = object.value->find(key);
  const std::string path = object.path.empty() ? key : object.path + "." + key;
  if (found == object.value->end()) fail({object.file, 0}, path + " is missing");
  return {&*found, object.file, path};
}

bool is_null(const JsonLocation& place) { return place.value->is_null(); }

std::vector<JsonLocation> elements(const JsonLocation& list) {
  require(list.value->is_array(), list, "a list");
  std::vector<JsonLocation> places;
  places.reserve(list.value->size());
  for (const nlohmann::json& value : *list.value) {
    places.push_back({&value, list.file, fmt::format("{}[{}]", list.path, places.size())});
  }
  return places;
}

std::string text_at(const JsonLocation& place) {
  require(place.value->is_string(), place, "a text");
  return place.value->get<std::string>();
}

bool truth_at(const JsonLocation& place) {
  require(place.value->is_boolean(), place, "true or false");
  return place.value->get<bool>();
}

std::uint64_t whole_at(const JsonLocation& place) {
  require(place.value->is_number_unsigned(), place, "a whole number from 0 on");
  return place.value->get<std::uint64_t>();
}

double number_at(const JsonLocation& place) {
  require(place.value->is_number(), place, "a number");
  const auto number = place.value->get<double>();
  if (!(std::abs(number) < kGreatest)) fail_at(place, "is beyond ±1e15");
  return number;
}

Eigen::Vector3d point_at(const JsonLocation& place) {
  const std::vector<JsonLocation> parts = elements(place);
  if (parts.size() != 3) {
    fail_at(place, fmt::format("has {} numbers, expected x, y, z", parts.size()));
  }
  return {number_at(parts[0]), number_at(parts[1]), number_at(parts[2])};
}

}  // namespace tagfield
