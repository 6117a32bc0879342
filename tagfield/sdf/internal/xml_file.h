// SPDX-License-Identifier: Apache-2.0
/// @file
/// XML files and what stands in their elements.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield::sdf_internal {

/// A parsed file; its elements find it by location_of().
struct XmlFile {
  std::string path;   ///< Absolute.
  std::string shown;  ///< As messages should show it.
  tinyxml2::XMLDocument document;
};

/// Parses the file at `file.path`. Declarations may stand anywhere, and values of attributes
/// without quotes, as in files that Gazebo takes.
/// Throws Error if it can't be read or is malformed.
void parse_xml(XmlFile& file);

/// The file that `element` is in.
const XmlFile& file_of(const tinyxml2::XMLElement& element);

/// Where `element` starts.
Location location_of(const tinyxml2::XMLElement& element);

/// The text of `element` without blanks around it and comments within.
std::string text_of(const tinyxml2::XMLElement& element);

/// The text of its first child `name`; "" without one.
std::string child_text(const tinyxml2::XMLElement& element, const char* name);

/// Versions of SDF in order: 1.2 is 1002 and 1.10 is 1010; 0 for what is no version.
int sdf_version(const std::string& text);

/// Whether a text of SDF's booleans says yes.
bool is_true(const std::string& text);

/// Its attribute, or "".
std::string attribute_of(const tinyxml2::XMLElement& element, const char* name);

/// Its attribute `name`. Throws Error where it has none.
std::string name_of(const tinyxml2::XMLElement& element);

/// The first `count` finite numbers of its text; more are warned of. Throws Error if there are
/// fewer.
std::vector<double> numbers_of(const tinyxml2::XMLElement& element, std::size_t count,
                               Diagnostics& diagnostics);

/// Calls `use` with each child element.
template <typename Use>
void for_each_child(const tinyxml2::XMLElement& element, const Use& use) {
  for (const tinyxml2::XMLElement* child = element.FirstChildElement(); child != nullptr;
       child = child->NextSiblingElement()) {
    use(*child);
  }
}

/// The same with each child of a name.
template <typename Use>
void for_each_child(const tinyxml2::XMLElement& element, const char* name, const Use& use) {
  for (const tinyxml2::XMLElement* child = element.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    use(*child);
  }
}

/// A <pose>: six numbers, [m] and [rad], or as its attributes `degrees` and `rotation_format` say;
/// none where it is empty. Throws Error where they are missing or not finite.
RigidTransform pose_of(const tinyxml2::XMLElement& pose, Diagnostics& diagnostics);

}  // namespace tagfield::sdf_internal
