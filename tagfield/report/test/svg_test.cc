// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/svg.h"

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/report/style_sheet.h"
#include "tagfield/report/test/balanced_tags.h"
#include "tagfield/report/test/text_holds.h"

namespace tagfield {
namespace {

TEST(Compact, DropsWhatSaysNothing) {
  EXPECT_EQ(compact(12.50), "12.5");
  EXPECT_EQ(compact(3.0), "3");
  EXPECT_EQ(compact(100.0), "100");
  EXPECT_EQ(compact(-0.001), "0");
  EXPECT_EQ(compact(std::numeric_limits<double>::quiet_NaN()), "0");
}

TEST(AddCircle, CarriesItsTooltip) {
  Svg svg;
  add_circle(svg, {1.0, 2.5}, 3.0, styled("truth"), "a < b");
  EXPECT_EQ(
      svg.body,
      "<circle cx=\"1\" cy=\"2.5\" r=\"3\" class=\"truth\"><title>a &lt; b</title></circle>\n");
}

TEST(AddText, EscapesItsText) {
  Svg svg;
  add_text(svg, {0.0, 0.0}, "</text><script>", Anchor::kEnd, "faint");
  EXPECT_FALSE(holds(svg.body, "<script>"));
  EXPECT_TRUE(holds(svg.body, "text-anchor=\"end\""));
}

TEST(StandaloneSvg, StandsAlone) {
  Svg svg;
  svg.height = 100.0;
  begin_clip(svg, "id", {0.0, 0.0}, {10.0, 10.0});
  add_diamond(svg, {5.0, 5.0}, 2.0, styled("truth"));
  add_cross(svg, {5.0, 5.0}, 2.0, styled("estimate"), "x");
  end_clip(svg);
  const std::string file = standalone_svg(svg, "A & B", "<caption>");
  EXPECT_EQ(unbalanced_tag(file), "");
  EXPECT_TRUE(holds(file, "xmlns=\"http://www.w3.org/2000/svg\""));
  EXPECT_TRUE(holds(file, "<title>A &amp; B</title>"));
  EXPECT_TRUE(holds(file, light_palette().truth));
  EXPECT_FALSE(holds(file, "var(--"));
}

TEST(PageStyle, HasBothThemesAndFetchesNothing) {
  const std::string style = page_style();
  EXPECT_TRUE(holds(style, "prefers-color-scheme:dark"));
  EXPECT_TRUE(holds(style, dark_palette().paper));
  EXPECT_FALSE(holds(style, "url("));
  EXPECT_FALSE(holds(style, "@import"));
}

}  // namespace
}  // namespace tagfield
