// SPDX-License-Identifier: Apache-2.0
/// @file
/// Where XML is malformed; tinyxml2 only reports the line in which it gave up.
#pragma once

#include <string>
#include <vector>

namespace tagfield::sdf_internal {

/// The start of an element.
struct XmlTag {
  std::string name;
  int line = 0;   ///< 1-based.
  int depth = 0;  ///< 0 for the root element.
};

/// All elements in file order, up to the first error.
struct XmlOutline {
  std::vector<XmlTag> tags;
  std::string error;   ///< What is malformed, or "".
  int error_line = 0;  ///< 1-based.
};

/// Parses tags, comments, CDATA and declarations, and ignores attributes and text. Not a validator:
/// malformed attributes go unnoticed.
XmlOutline outline_xml(const std::string& text);

}  // namespace tagfield::sdf_internal
