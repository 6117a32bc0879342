/// @file
/// The lines on which an XML file's elements start. sdformat knows them for the elements of SDF but
/// not for a plugin's own, and doesn't say where XML is malformed.
#pragma once

#include <string>
#include <vector>

namespace tagfield::sdf_internal {

/// An element's start.
struct XmlTag {
  std::string name;
  int line = 0;   ///< 1-based.
  int depth = 0;  ///< 0 for the root element.
};

/// All elements in the order of the file, as far as it is well-formed.
struct XmlOutline {
  std::vector<XmlTag> tags;
  std::string error;   ///< What is malformed, or "".
  int error_line = 0;  ///< 1-based.
};

/// Sees tags, comments, CDATA and declarations; leaves attributes and text alone. Not a validator:
/// malformed attributes go unnoticed.
XmlOutline outline_xml(const std::string& text);

/// The lines of the children of the first element `name` that starts on `line`; empty if none does.
std::vector<int> child_lines(const XmlOutline& outline, const std::string& name, int line);

}  // namespace tagfield::sdf_internal
