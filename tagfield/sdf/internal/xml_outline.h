// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where XML is malformed, which tinyxml2 tells by the line in which it gave up.
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

}  // namespace tagfield::sdf_internal
