// SPDX-License-Identifier: Apache-2.0
/// @file
/// XML elements with text, poses and names in SDF's formats.
#pragma once

#include <tinyxml2.h>

#include <set>
#include <string>

#include "tagfield/base/error.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield::gazebo_world_internal {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

/// Adds <name> at the end of `parent`.
XMLElement* add(XMLElement* parent, const char* name);
XMLElement* add(XMLElement* parent, const char* name, const std::string& text);
/// Writes the number with all digits.
XMLElement* add(XMLElement* parent, const char* name, double number);
/// With an attribute `name`.
XMLElement* add_named(XMLElement* parent, const char* element, const std::string& name);
/// Adds <plugin>, named like its file without "lib" and ".so".
XMLElement* add_plugin(XMLElement* parent, const std::string& file);
/// Adds <pose>, unless it is the identity.
void add_pose(XMLElement* parent, const RigidTransform& pose);

/// Replaces the text of the first child <name>, or adds it.
void set(XMLElement* parent, const char* name, const std::string& text);

/// "x y z roll pitch yaw" with all digits.
std::string pose_text(const RigidTransform& pose);
/// Pose from text as returned by pose_text(), or with fewer numbers; missing ones are 0.
RigidTransform pose_from(const char* text);

/// Reads an XML file. Throws Error "FILE:LINE: …".
void read_xml(const std::string& path, XMLDocument& document);

/// Throws Error "LOCATION: …" if XML can't represent `text` as it is, or if reading would trim it.
void require_xml_text(const std::string& text, const char* what, const Location& location);

/// Unique names.
class Names {
 public:
  /// Marks a name as taken.
  void reserve(const std::string& name) { taken_.insert(name); }
  /// `wanted`, valid in SDF and ROS: characters other than letters, digits and '_' become '_', and
  /// a number is appended if the name is taken.
  std::string make(const std::string& wanted);

 private:
  std::set<std::string> taken_ = {"world"};  // reserved by SDF
};

}  // namespace tagfield::gazebo_world_internal
