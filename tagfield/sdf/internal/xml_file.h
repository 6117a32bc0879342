// SPDX-License-Identifier: Apache-2.0
/// @file
/// XML files and the contents of their elements.
#pragma once

#include <tinyxml2.h>

#include <Eigen/Core>
#include <string>
#include <vector>

#include "tagfield/base/error.h"
#include "tagfield/poses/rigid_transform.h"

namespace tagfield::sdf_internal {

/// A parsed file; location_of() finds it from its elements.
struct XmlFile {
  std::string path;   ///< Absolute.
  std::string shown;  ///< Its name in messages.
  tinyxml2::XMLDocument document;
};

/// Parses the file at `file.path`. Declarations may appear anywhere, and attribute values may lack
/// quotes, as in files that Gazebo accepts. Throws Error if it can't be read or is malformed.
void parse_xml(XmlFile& file);

/// Same for the given text.
void parse_xml(XmlFile& file, std::string text);

/// The file that `element` is in.
const XmlFile& file_of(const tinyxml2::XMLElement& element);

/// The position where `element` starts.
Location location_of(const tinyxml2::XMLElement& element);

/// The text of `element` without surrounding white space and without comments.
std::string text_of(const tinyxml2::XMLElement& element);

/// The text of its first child `name`; "" without one.
std::string child_text(const tinyxml2::XMLElement& element, const char* name);

/// Versions of SDF as ordered numbers: 1.2 is 1002 and 1.10 is 1010; 0 for an invalid version.
int sdf_version(const std::string& text);

/// Whether the text of an SDF Boolean is true.
bool is_true(const std::string& text);

/// Its attribute, or "".
std::string attribute_of(const tinyxml2::XMLElement& element, const char* name);

/// Its attribute `name`. Throws Error if it has none.
std::string name_of(const tinyxml2::XMLElement& element);

/// The first `count` finite numbers of its text; warns of any further ones. Throws Error if there
/// are fewer.
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

/// Same for the children with a given name.
template <typename Use>
void for_each_child(const tinyxml2::XMLElement& element, const char* name, const Use& use) {
  for (const tinyxml2::XMLElement* child = element.FirstChildElement(name); child != nullptr;
       child = child->NextSiblingElement(name)) {
    use(*child);
  }
}

/// A <pose>: six numbers, [m] and [rad], or as given by its attributes `degrees` and
/// `rotation_format`; the identity if it is empty. Numbers missing at its end are 0 (with a
/// warning), as in Gazebo 11. Throws Error for anything that is not a finite number, and for an
/// incomplete quaternion.
RigidTransform pose_of(const tinyxml2::XMLElement& pose, Diagnostics& diagnostics);

}  // namespace tagfield::sdf_internal
