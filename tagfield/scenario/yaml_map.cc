// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/yaml_map.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "tagfield/base/range_check.h"
#include "tagfield/base/spelling.h"
#include "tagfield/base/wildcard.h"
#include "tagfield/files/files.h"

namespace tagfield {
namespace {

constexpr double kMost = 1e15;  // For any other number.
constexpr std::size_t kMaxYamlBytes = 16'000'000;
constexpr std::size_t kMaxKeys = 100'000;
constexpr int kMaxLevels = 100;  // Of nested lists and maps; a node may contain itself.
constexpr const char* kCommandLine = "--set";
// Tag of YAML nodes that did not come from the file.
constexpr const char* kFromCommandLine = "!set";

bool ends_in(const std::string& text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

/// The maximum by the unit in the key: metres, but not siemens per metre.
double most_of(const YamlValue& value) {
  const bool is_length = ends_in(value.path(), "_m") && !ends_in(value.path(), "_s_m");
  return is_length ? kMaxLength_m : kMost;
}

void require_in_range(const YamlValue& value, double number, NumberRange range) {
  if (!std::isfinite(number)) value.fail(fmt::format("must be finite, is {}", number));
  if (std::abs(number) > most_of(value)) {
    value.fail(fmt::format("must be within ±{:g}, is {:g}", most_of(value), number));
  }
  if (range == NumberRange::kPositive && !(number > 0.0)) {
    value.fail(fmt::format("must be greater than 0, is {}", number));
  }
  if (range == NumberRange::kNotNegative && number < 0.0) {
    value.fail(fmt::format("must be 0 or more, is {}", number));
  }
}

/// Requires that all keys are text and unique.
void require_unique_keys(const YamlValue& map) {
  if (map.node().size() > kMaxKeys) {
    map.fail(fmt::format("has {} keys, expected at most {}", map.node().size(), kMaxKeys));
  }
  std::set<std::string> keys;
  for (const auto& entry : map.node()) {
    const YamlValue place(entry.first, map.file(), map.path());
    if (!entry.first.IsScalar()) place.fail("has a key that is not text");
    const auto key = entry.first.as<std::string>();
    if (!keys.insert(key).second) place.fail(fmt::format("has '{}' twice", key));
  }
}

/// Element of a list by its index, its `name` or its `id`.
YAML::Node element_of(const YAML::Node& list, const std::string& which) {
  std::size_t place = 0;
  const char* end = which.data() + which.size();
  const auto [after, error] = std::from_chars(which.data(), end, place);
  if (error == std::errc{} && after == end && place < list.size()) return list[place];
  for (const YAML::Node& element : list) {
    if (!element.IsMap()) continue;
    for (const char* key : {"name", "id"}) {
      if (element[key] && element[key].as<std::string>("") == which) return element;
    }
  }
  return YAML::Node(YAML::NodeType::Undefined);
}

/// The elements of a list that a word refers to: one by its index, its `name` or its `id`, or all
/// that match a pattern.
std::vector<YAML::Node> elements_of(const YAML::Node& list, const std::string& which) {
  if (!is_pattern(which)) {
    const YAML::Node element = element_of(list, which);
    return element.IsDefined() ? std::vector<YAML::Node>{element} : std::vector<YAML::Node>{};
  }
  std::vector<YAML::Node> all;
  for (const YAML::Node& element : list) {
    if (!element.IsMap()) continue;
    const auto is_called = [&](const char* key) {
      return element[key] && matches(which, element[key].as<std::string>(""));
    };
    if (is_called("name") || is_called("id")) all.push_back(element);
  }
  return all;
}

std::vector<std::string> split_at_dots(std::string_view path) {
  std::vector<std::string> words;
  std::size_t begin = 0;
  for (std::size_t dot = path.find('.'); dot != std::string_view::npos;
       dot = path.find('.', begin)) {
    words.emplace_back(path.substr(begin, dot - begin));
    begin = dot + 1;
  }
  words.emplace_back(path.substr(begin));
  return words;
}

/// Writers of YAML 1.1, such as PyYAML, take the key 'on' for a truth value unless it is text.
constexpr const char* kMisreadOn =
    " (is it the key 'on', written by a program for YAML 1.1? Quote it there: 'on')";

bool is_misread_on(const std::string& key, const std::vector<std::string>& known) {
  return (key == "true" || key == "True") &&
         std::find(known.begin(), known.end(), "on") != known.end();
}

[[noreturn]] void leads_nowhere(std::string_view key_path, const std::string& why) {
  fail({fmt::format("{} {}", kCommandLine, key_path), 0}, why);
}

void mark_as_from_command_line(YAML::Node node, int levels = kMaxLevels) {
  if (levels == 0) throw Error("contains itself, or nests lists and maps too deeply");
  node.SetTag(kFromCommandLine);
  if (node.IsSequence()) {
    for (const YAML::Node& element : node) mark_as_from_command_line(element, levels - 1);
  }
  if (node.IsMap()) {
    for (const auto& entry : node) {
      mark_as_from_command_line(entry.first, levels - 1);
      mark_as_from_command_line(entry.second, levels - 1);
    }
  }
}

YAML::Node parse_value(std::string_view key_path, const std::string& text) {
  try {
    const YAML::Node value = YAML::Load(text);
    mark_as_from_command_line(value);
    return value;
  } catch (const YAML::Exception& error) {
    leads_nowhere(key_path, fmt::format("'{}' is not a YAML value: {}", text, error.msg));
  } catch (const Error& error) {
    leads_nowhere(key_path, error.what());
  }
}

/// The child under `key`, created if there is none.
YAML::Node child_of(YAML::Node map, const std::string& key) {
  if (!map[key].IsDefined() || map[key].IsNull()) map[key] = YAML::Node(YAML::NodeType::Map);
  return map[key];
}

/// Sets the node below `parent` that the words from `depth` on refer to.
void set_below(YAML::Node parent, std::string_view key_path, const std::vector<std::string>& words,
               std::size_t depth, const std::string& value) {
  const std::string& word = words[depth];
  const bool last = depth + 1 == words.size();
  if (word.empty()) leads_nowhere(key_path, "expected words between the dots");
  if (parent.IsMap()) {
    if (last) {
      parent[word] = parse_value(key_path, value);
    } else {
      set_below(child_of(parent, word), key_path, words, depth + 1, value);
    }
    return;
  }
  if (!parent.IsSequence()) {
    leads_nowhere(key_path, fmt::format("'{}' is not inside a list or a mapping", word));
  }
  const std::vector<YAML::Node> elements = elements_of(parent, word);
  if (elements.empty()) {
    leads_nowhere(key_path, fmt::format("the list has no element '{}'", word));
  }
  for (YAML::Node element : elements) {
    if (last) {
      element = parse_value(key_path, value);
    } else {
      set_below(element, key_path, words, depth + 1, value);
    }
  }
}

}  // namespace

void YamlValue::fail(const std::string& message) const {
  tagfield::fail(location(), path_.empty() ? message : fmt::format("{} {}", path_, message));
}

Location YamlValue::location() const {
  if (node_.Tag() == kFromCommandLine) return {kCommandLine, 0};
  const YAML::Mark mark = node_.Mark();
  return {file_, mark.is_null() ? 0 : mark.line + 1};
}

double YamlValue::number(NumberRange range) const {
  double number = 0.0;
  if (!node_.IsScalar() || !YAML::convert<double>::decode(node_, number)) {
    fail(node_.IsScalar() ? fmt::format("is '{}', expected a number", node_.Scalar())
                          : "must be a number");
  }
  require_in_range(*this, number, range);
  return number;
}

std::uint64_t YamlValue::whole_number() const {
  std::uint64_t number = 0;
  const std::string word = node_.IsScalar() ? node_.Scalar() : "";
  const char* end = word.data() + word.size();
  const auto [after, error] = std::from_chars(word.data(), end, number);
  if (word.empty() || error != std::errc{} || after != end) {
    fail(fmt::format("is '{}', expected a whole number, 0 or more", word));
  }
  return number;
}

bool YamlValue::boolean() const {
  bool value = false;
  if (!node_.IsScalar() || !YAML::convert<bool>::decode(node_, value)) {
    fail("must be true or false");
  }
  return value;
}

std::string YamlValue::text() const {
  if (!node_.IsScalar() || node_.Scalar().empty()) fail("must be a text that is not empty");
  if (node_.Scalar().find('\0') != std::string::npos) fail("holds a NUL byte");
  return node_.Scalar();
}

std::vector<YamlValue> YamlValue::list() const {
  if (node_.IsNull()) return {};
  if (!node_.IsSequence()) fail("must be a list");
  std::vector<YamlValue> elements;
  for (std::size_t i = 0; i < node_.size(); ++i) {
    elements.emplace_back(node_[i], file_, fmt::format("{}[{}]", path_, i));
  }
  return elements;
}

std::vector<double> YamlValue::numbers(std::size_t least, std::size_t most) const {
  std::vector<double> numbers;
  for (const YamlValue& element : list()) numbers.push_back(element.number());
  if (numbers.size() < least || numbers.size() > most) {
    const std::string expected =
        least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most);
    fail(fmt::format("must have {} numbers, has {}", expected, numbers.size()));
  }
  return numbers;
}

std::vector<double> YamlValue::lengths(std::size_t least, std::size_t most) const {
  std::vector<double> lengths = numbers(least, most);
  for (const double length_m : lengths) require_length(length_m);
  return lengths;
}

void YamlValue::require_length(double length_m) const {
  if (std::abs(length_m) <= kMaxLength_m) return;
  fail(fmt::format("must be within ±{:g} m, is {:g}", kMaxLength_m, length_m));
}

YamlMap::YamlMap(YamlValue value) : self_(std::move(value)) {
  if (!self_.node().IsMap()) self_.fail("must be a mapping (key: value)");
  require_unique_keys(self_);
}

bool YamlMap::has(const std::string& key) {
  if (!is_known(key)) known_.push_back(key);
  const YAML::Node value = self_.node()[key];
  return value.IsDefined() && !value.IsNull();
}

YamlValue YamlMap::at(const std::string& key, std::string_view expected) {
  if (!has(key)) {
    complain_of_slip(key);
    const std::string form =
        expected.empty() ? "" : fmt::format(" (expected {}: {})", key, expected);
    self_.fail(fmt::format("has no '{}'{}", key, form));
  }
  const std::string path = self_.path().empty() ? key : self_.path() + "." + key;
  return {self_.node()[key], self_.file(), path};
}

double YamlMap::number(const std::string& key, double otherwise, NumberRange range) {
  return has(key) ? at(key).number(range) : otherwise;
}

std::string YamlMap::text(const std::string& key, const std::string& otherwise) {
  return has(key) ? at(key).text() : otherwise;
}

bool YamlMap::boolean(const std::string& key, bool otherwise) {
  return has(key) ? at(key).boolean() : otherwise;
}

std::vector<YamlValue> YamlMap::list(const std::string& key) {
  return has(key) ? at(key).list() : std::vector<YamlValue>{};
}

bool YamlMap::is_known(const std::string& key) const {
  return std::find(known_.begin(), known_.end(), key) != known_.end();
}

void YamlMap::fail_on_unknown(const YAML::Node& key, const YAML::Node& value,
                              const std::vector<std::string>& known) const {
  const bool from_file = value.Tag() != kFromCommandLine;
  const std::string word = key.as<std::string>("");
  const Location location = YamlValue(from_file ? key : value, self_.file(), word).location();
  const std::string where = self_.path().empty() ? "" : fmt::format(" in {}", self_.path());
  tagfield::fail(location,
                 fmt::format("unknown key '{}'{}{}", word, where,
                             is_misread_on(word, known) ? kMisreadOn : suggestion(word, known)));
}

void YamlMap::complain_of_slip(const std::string& missing) const {
  for (const auto& entry : self_.node()) {
    const std::string key = entry.first.as<std::string>("");
    if (!is_known(key) && !nearest_word(key, {missing}).empty()) {
      fail_on_unknown(entry.first, entry.second, {missing});
    }
  }
}

void YamlMap::finish() const {
  for (const auto& entry : self_.node()) {
    if (!is_known(entry.first.as<std::string>(""))) {
      fail_on_unknown(entry.first, entry.second, known_);
    }
  }
}

YAML::Node read_yaml(const std::string& path) {
  return yaml_in(read_text_file(path, kMaxYamlBytes), path);
}

YAML::Node yaml_in(const std::string& text, const std::string& path) {
  try {
    YAML::Node root = YAML::Load(text);
    if (!root.IsMap())
      fail({path, 0}, "must be a mapping (key: value), like the shipped scenarios");
    return root;
  } catch (const YAML::Exception& error) {
    fail({path, error.mark.line + 1}, fmt::format("not valid YAML: {}", error.msg));
  }
}

void set_in_yaml(const YAML::Node& root, std::string_view key_path, const std::string& value) {
  set_below(root, key_path, split_at_dots(key_path), 0, value);
}

}  // namespace tagfield
