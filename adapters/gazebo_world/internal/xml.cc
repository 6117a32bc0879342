// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/internal/xml.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <sstream>

namespace tagfield::gazebo_world_internal {
namespace {

/// Roll, pitch and yaw of from_xyz_rpy() [rad].
Eigen::Vector3d rpy_of(const Eigen::Quaterniond& rotation) {
  const Eigen::Matrix3d R = rotation.toRotationMatrix();
  const double cos_pitch = std::hypot(R(0, 0), R(1, 0));
  const double pitch = std::atan2(-R(2, 0), cos_pitch);
  if (cos_pitch < 1e-9) return {0.0, pitch, std::atan2(-R(0, 1), R(1, 1))};
  return {std::atan2(R(2, 1), R(2, 2)), pitch, std::atan2(R(1, 0), R(0, 0))};
}

}  // namespace

XMLElement* add(XMLElement* parent, const char* name) {
  XMLElement* const child = parent->GetDocument()->NewElement(name);
  parent->InsertEndChild(child);
  return child;
}

XMLElement* add(XMLElement* parent, const char* name, const std::string& text) {
  XMLElement* const child = add(parent, name);
  child->SetText(text.c_str());
  return child;
}

XMLElement* add(XMLElement* parent, const char* name, double number) {
  return add(parent, name, fmt::format("{}", number));
}

XMLElement* add_named(XMLElement* parent, const char* element, const std::string& name) {
  XMLElement* const child = add(parent, element);
  child->SetAttribute("name", name.c_str());
  return child;
}

XMLElement* add_plugin(XMLElement* parent, const std::string& file) {
  constexpr std::size_t kAround = 3;  // "lib" and ".so"
  XMLElement* const plugin =
      add_named(parent, "plugin", file.substr(kAround, file.size() - 2 * kAround));
  plugin->SetAttribute("filename", file.c_str());
  return plugin;
}

void add_pose(XMLElement* parent, const RigidTransform& pose) {
  const std::string text = pose_text(pose);
  if (text != "0 0 0 0 0 0") add(parent, "pose", text);
}

void set(XMLElement* parent, const char* name, const std::string& text) {
  XMLElement* const child = parent->FirstChildElement(name);
  (child != nullptr ? child : add(parent, name))->SetText(text.c_str());
}

std::string pose_text(const RigidTransform& pose) {
  const Eigen::Vector3d& p = pose.translation;
  const Eigen::Vector3d rpy = rpy_of(pose.rotation);
  // Adding 0 turns -0 into 0.
  return fmt::format("{} {} {} {} {} {}", p.x() + 0.0, p.y() + 0.0, p.z() + 0.0, rpy.x() + 0.0,
                     rpy.y() + 0.0, rpy.z() + 0.0);
}

RigidTransform pose_from(const char* text) {
  std::array<double, 6> n{};
  std::istringstream words(text == nullptr ? "" : text);
  for (double& number : n) words >> number;
  return from_xyz_rpy({n[0], n[1], n[2]}, {n[3], n[4], n[5]});
}

void read_xml(const std::string& path, XMLDocument& document) {
  if (document.LoadFile(path.c_str()) == tinyxml2::XML_SUCCESS) return;
  if (document.ErrorLineNum() == 0) fail({path, 0}, "can't be read");
  fail({path, document.ErrorLineNum()}, "malformed XML");
}

void require_xml_text(const std::string& text, const char* what, const Location& location) {
  const auto is_control = [](char c) { return static_cast<unsigned char>(c) < ' '; };
  const bool trimmed = text.empty() || text.front() == ' ' || text.back() == ' ';
  if (trimmed || std::any_of(text.begin(), text.end(), is_control)) {
    fail(location, fmt::format("{} '{}' can't be used in a world file: expected no control "
                               "characters and no spaces at its ends",
                               what, text));
  }
}

std::string Names::make(const std::string& wanted) {
  std::string plain = wanted;
  for (char& c : plain) {
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  }
  // SDF reserves names such as __model__.
  if (plain.rfind("__", 0) == 0) plain = "x" + plain;
  std::string name = plain;
  for (int number = 2; !taken_.insert(name).second; ++number) {
    name = fmt::format("{}_{}", plain, number);
  }
  return name;
}

}  // namespace tagfield::gazebo_world_internal
