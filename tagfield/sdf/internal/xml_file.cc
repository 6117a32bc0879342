// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/xml_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <sstream>
#include <utility>

#include "tagfield/base/number.h"
#include "tagfield/base/units.h"
#include "tagfield/files/files.h"
#include "tagfield/sdf/internal/xml_outline.h"

namespace tagfield::sdf_internal {
namespace {

using tinyxml2::XMLElement;

constexpr std::size_t kMaxBytes = 200'000'000;

/// Blanks out all declarations, <?xml …?>, which are otherwise accepted only at the start; line
/// numbers don't change.
void blank_out_declarations(std::string& text) {
  for (std::size_t begin = text.find("<?"); begin != std::string::npos;
       begin = text.find("<?", begin)) {
    const std::size_t end = text.find("?>", begin);
    if (end == std::string::npos) return;
    const auto at = [&](std::size_t i) { return text.begin() + static_cast<std::ptrdiff_t>(i); };
    std::replace_if(
        at(begin), at(end + 2), [](char c) { return c != '\n'; }, ' ');
  }
}

/// The text with quotes added around attribute values that have none, which Gazebo 11 accepts:
/// <link name=a> becomes <link name="a">.
std::string with_quotes(const std::string& text) {
  constexpr const char* kBlank = " \t\r\n";
  std::string quoted;
  bool in_tag = false;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (!in_tag && text.compare(i, 4, "<!--") == 0) {
      const std::size_t end = std::min(text.find("-->", i), text.size());
      quoted += text.substr(i, end - i);
      i = end;
      if (i == text.size()) break;
    }
    quoted += text[i];
    if (text[i] == '<') in_tag = true;
    if (text[i] == '>') in_tag = false;
    if (!in_tag || (text[i] != '=' && text[i] != '"' && text[i] != '\'')) continue;
    if (text[i] != '=') {
      const std::size_t end = std::min(text.find(text[i], i + 1), text.size() - 1);
      quoted += text.substr(i + 1, end - i);
      i = end;
      continue;
    }
    const std::size_t begin = text.find_first_not_of(kBlank, i + 1);
    if (begin == std::string::npos || text[begin] == '"' || text[begin] == '\'') continue;
    const std::size_t end = std::min(text.find_first_of(" \t\r\n/>", begin), text.size());
    quoted += text.substr(i + 1, begin - i - 1) + '"' + text.substr(begin, end - begin) + '"';
    i = end - 1;
  }
  return quoted;
}

bool parse(XmlFile& file, const std::string& text) {
  return file.document.Parse(text.data(), text.size()) == tinyxml2::XML_SUCCESS &&
         file.document.RootElement() != nullptr;
}

/// The outline gives a better message, if it detects the error.
[[noreturn]] void refuse_malformed(const XmlFile& file, const std::string& text) {
  const XmlOutline outline = outline_xml(text);
  if (outline.tags.empty()) fail({file.shown, std::max(outline.error_line, 1)}, "not an XML file");
  if (!outline.error.empty()) {
    fail({file.shown, outline.error_line}, "malformed XML: " + outline.error);
  }
  fail({file.shown, file.document.ErrorLineNum()},
       fmt::format("malformed XML ({})",
                   tinyxml2::XMLDocument::ErrorIDToName(file.document.ErrorID())));
}

/// Roll, pitch and yaw about fixed axes, as in SDF.
Eigen::Quaterniond from_roll_pitch_yaw(double roll, double pitch, double yaw) {
  const double cr = std::cos(roll / 2.0);
  const double sr = std::sin(roll / 2.0);
  const double cp = std::cos(pitch / 2.0);
  const double sp = std::sin(pitch / 2.0);
  const double cy = std::cos(yaw / 2.0);
  const double sy = std::sin(yaw / 2.0);
  const double w = cr * cp * cy + sr * sp * sy;
  const double x = sr * cp * cy - cr * sp * sy;
  const double y = cr * sp * cy + sr * cp * sy;
  const double z = cr * cp * sy - sr * sp * cy;
  const double length = std::sqrt(w * w + x * x + y * y + z * z);
  return Eigen::Quaterniond(w / length, x / length, y / length, z / length).normalized();
}

/// The first numbers of an element's text.
struct LeadingNumbers {
  std::vector<double> numbers;  ///< All are finite.
  bool is_all = true;           ///< Whether there is nothing else in the text.
};

/// At most `count` of them.
LeadingNumbers leading_numbers(const XMLElement& element, std::size_t count) {
  LeadingNumbers found;
  std::istringstream words(text_of(element));
  for (std::string word; words >> word;) {
    const auto number = found.numbers.size() < count ? parse_number(word) : std::nullopt;
    if (!number) {
      found.is_all = false;
      break;
    }
    found.numbers.push_back(*number);
  }
  return found;
}

[[noreturn]] void refuse_numbers(const XMLElement& element, std::size_t count) {
  fail(location_of(element),
       fmt::format("missing or bad value in <{}>: '{}' (expected {} number{})", element.Name(),
                   text_of(element), count, count == 1 ? "" : "s"));
}

void warn_of_more(const XMLElement& element, std::size_t count, Diagnostics& diagnostics) {
  const std::string used =
      count == 1 ? "the first number is" : fmt::format("the first {} numbers are", count);
  diagnostics.warn(location_of(element), fmt::format("of '{}' in <{}> only {} used",
                                                     text_of(element), element.Name(), used));
}

/// The six numbers of a pose; those missing at its end are 0, as in Gazebo 11.
std::vector<double> pose_numbers(const XMLElement& pose, Diagnostics& diagnostics) {
  constexpr std::size_t kCount = 6;
  LeadingNumbers found = leading_numbers(pose, kCount);
  if (found.numbers.size() == kCount) {
    if (!found.is_all) warn_of_more(pose, kCount, diagnostics);
    return found.numbers;
  }
  if (!found.is_all) refuse_numbers(pose, kCount);
  diagnostics.warn(location_of(pose),
                   fmt::format("of 6 numbers in <pose> only the first {} are there: '{}'; 0 is "
                               "assumed for the others, as in Gazebo 11",
                               found.numbers.size(), text_of(pose)));
  found.numbers.resize(kCount, 0.0);
  return found.numbers;
}

RigidTransform pose_with_quaternion(const XMLElement& pose, const std::vector<double>& n) {
  const auto rotation = as_rotation(Eigen::Quaterniond(n[6], n[3], n[4], n[5]));
  if (!rotation) fail(location_of(pose), "the quaternion in <pose> must be of length 1");
  return {*rotation, {n[0], n[1], n[2]}};
}

}  // namespace

void parse_xml(XmlFile& file) {
  std::string text;
  try {
    text = read_text_file(file.path, kMaxBytes);
  } catch (const Error& error) {
    // The path as the caller wrote it, not as resolved.
    std::string message = error.what();
    if (message.rfind(file.path, 0) == 0) message.replace(0, file.path.size(), file.shown);
    throw Error(message);
  }
  parse_xml(file, std::move(text));
}

void parse_xml(XmlFile& file, std::string text) {
  blank_out_declarations(text);
  file.document.SetUserData(&file);
  if (parse(file, text)) return;
  const bool lacks_quotes = file.document.ErrorID() == tinyxml2::XML_ERROR_PARSING_ATTRIBUTE;
  if (!lacks_quotes || !parse(file, with_quotes(text))) refuse_malformed(file, text);
}

const XmlFile& file_of(const XMLElement& element) {
  return *static_cast<const XmlFile*>(element.GetDocument()->GetUserData());
}

Location location_of(const XMLElement& element) {
  return {file_of(element).shown, element.GetLineNum()};
}

std::string text_of(const XMLElement& element) {
  constexpr const char* kBlank = " \t\r\n";
  std::string text;
  for (const tinyxml2::XMLNode* node = element.FirstChild(); node != nullptr;
       node = node->NextSibling()) {
    if (node->ToText() != nullptr) text += node->Value();
  }
  const std::size_t begin = text.find_first_not_of(kBlank);
  if (begin == std::string::npos) return "";
  return text.substr(begin, text.find_last_not_of(kBlank) + 1 - begin);
}

std::string child_text(const XMLElement& element, const char* name) {
  const XMLElement* child = element.FirstChildElement(name);
  return child == nullptr ? "" : text_of(*child);
}

int sdf_version(const std::string& text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string::npos) return 0;
  const auto major = parse_number(text.substr(0, dot));
  const auto minor = parse_number(text.substr(dot + 1));
  if (!major || !minor || *major < 0.0 || *major > 1000.0 || *minor < 0.0 || *minor > 999.0) {
    return 0;
  }
  return 1000 * static_cast<int>(*major) + static_cast<int>(*minor);
}

bool is_true(const std::string& text) { return text == "true" || text == "1"; }

std::string attribute_of(const XMLElement& element, const char* name) {
  const char* value = element.Attribute(name);
  return value == nullptr ? "" : value;
}

std::string name_of(const XMLElement& element) {
  std::string name = attribute_of(element, "name");
  if (name.empty()) {
    fail(location_of(element), fmt::format("<{}> without a name", element.Name()));
  }
  return name;
}

std::vector<double> numbers_of(const XMLElement& element, std::size_t count,
                               Diagnostics& diagnostics) {
  LeadingNumbers found = leading_numbers(element, count);
  if (found.numbers.size() < count) refuse_numbers(element, count);
  if (!found.is_all) warn_of_more(element, count, diagnostics);
  return found.numbers;
}

RigidTransform pose_of(const XMLElement& pose, Diagnostics& diagnostics) {
  if (text_of(pose).empty()) return {};
  if (attribute_of(pose, "rotation_format") == "quat_xyzw") {
    return pose_with_quaternion(pose, numbers_of(pose, 7, diagnostics));
  }
  const std::vector<double> n = pose_numbers(pose, diagnostics);
  const double unit = pose.BoolAttribute("degrees", false) ? kPi / 180.0 : 1.0;
  return {from_roll_pitch_yaw(unit * n[3], unit * n[4], unit * n[5]), {n[0], n[1], n[2]}};
}

}  // namespace tagfield::sdf_internal
