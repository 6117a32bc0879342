// SPDX-License-Identifier: Apache-2.0
/// @file
/// XML elements with text, poses and names as SDF has them.
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
/// With all digits that the number has.
XMLElement* add(XMLElement* parent, const char* name, double number);
/// With an attribute `name`.
XMLElement* add_named(XMLElement* parent, const char* element, const std::string& name);
/// <plugin> that is called as its file, without "lib" and ".so".
XMLElement* add_plugin(XMLElement* parent, const std::string& file);
/// <pose>, unless it is the identity.
void add_pose(XMLElement* parent, const RigidTransform& pose);

/// Replaces the text of the first child <name>, or adds it.
void set(XMLElement* parent, const char* name, const std::string& text);

/// "x y z roll pitch yaw" with all digits.
std::string pose_text(const RigidTransform& pose);
/// Of text as pose_text() makes it, or with fewer numbers; the rest are 0.
RigidTransform pose_from(const char* text);

/// Reads an XML file. Throws Error "FILE:LINE: …".
void read_xml(const std::string& path, XMLDocument& document);

/// Throws Error "LOCATION: …" if XML can't hold `text` as it is, or if reading would trim it.
void require_xml_text(const std::string& text, const char* what, const Location& location);

/// Names, each given out once.
class Names {
 public:
  /// Takes a name out of the supply.
  void reserve(const std::string& name) { taken_.insert(name); }
  /// `wanted` with characters other than letters, digits and '_' made '_', and a number behind it
  /// where that is taken: a name for SDF and for ROS.
  std::string make(const std::string& wanted);

 private:
  std::set<std::string> taken_ = {"world"};  // SDF's own
};

}  // namespace tagfield::gazebo_world_internal
