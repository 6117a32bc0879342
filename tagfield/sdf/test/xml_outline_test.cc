// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/internal/xml_outline.h"

#include <gtest/gtest.h>

#include <tuple>

namespace tagfield::sdf_internal {
namespace {

std::string spelled(const XmlOutline& outline) {
  std::string text;
  for (const XmlTag& tag : outline.tags) {
    text += tag.name + "@" + std::to_string(tag.line) + "/" + std::to_string(tag.depth) + " ";
  }
  return text;
}

TEST(XmlOutline, NamesLinesAndDepths) {
  const XmlOutline outline = outline_xml(
      "<?xml version='1.0'?>\n<a x='1'>\n <b/>\n<c\n y='2'>t\n"
      "<d></d></c>\n</a>");
  EXPECT_EQ(spelled(outline), "a@2/0 b@3/1 c@4/1 d@6/2 ");
  EXPECT_EQ(outline.error, "");
}

TEST(XmlOutline, SkipsCommentsDataAndDeclarations) {
  const XmlOutline outline = outline_xml(
      "<!DOCTYPE a>\n<a><!-- <b>\n -- > -->\n<![CDATA[<c>]]>"
      "<d e='<f>' g=\"a>b\"/></a>");
  EXPECT_EQ(spelled(outline), "a@2/0 d@4/1 ");
  EXPECT_EQ(outline.error, "");
}

TEST(XmlOutline, SaysWhereItIsMalformed) {
  const std::vector<std::tuple<std::string, std::string, int>> cases = {
      {"<a>\n<b>\n</a>", "</a> where </b> was expected (<b> is on line 2)", 3},
      {"<a>\n<b></b>\n", "<a> is never closed", 1},
      {"<a/>\n</a>", "</a> closes nothing", 2},
      {"<a>\n<b", "a tag is never ended", 2},
      {"<a>\n<!-- ", "<!-- is never closed", 2},
      {"<a>\n< b></a>", "'<' without a name", 2}};
  for (const auto& [text, error, line] : cases) {
    EXPECT_EQ(outline_xml(text).error, error);
    EXPECT_EQ(outline_xml(text).error_line, line) << text;
  }
}

TEST(XmlOutline, NoTagsAtAll) { EXPECT_TRUE(outline_xml("hello").tags.empty()); }

}  // namespace
}  // namespace tagfield::sdf_internal
