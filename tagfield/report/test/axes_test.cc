// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/axes.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

TEST(PlaceIn, PutsDataBetweenTheEnds) {
  const Axes axes{{0.0, 10.0, 100.0, 200.0, {}, false}, {-1.0, 1.0, 300.0, 50.0, {}, false}};
  EXPECT_TRUE(place_in(axes, 0.0, -1.0).isApprox(Place(100.0, 300.0)));
  EXPECT_TRUE(place_in(axes, 5.0, 0.0).isApprox(Place(150.0, 175.0)));
  EXPECT_TRUE(place_in(axes, 10.0, 1.0).isApprox(Place(200.0, 50.0)));
}

TEST(LogarithmicScale, PutsDecadesEvenlyApart) {
  Scale scale = logarithmic_scale(1.0, 100.0);
  scale.from = 0.0;
  scale.to = 200.0;
  EXPECT_DOUBLE_EQ(scale.low, 1.0);
  EXPECT_DOUBLE_EQ(scale.high, 100.0);
  EXPECT_NEAR(place_on(scale, 10.0), 100.0, 1e-9);
  EXPECT_NEAR(place_on(scale, 0.0), 0.0, 1e-9);
}

TEST(LogarithmicScale, EndsAtRoundNumbersAround) {
  const Scale scale = logarithmic_scale(3.3, 420.0);
  EXPECT_NEAR(scale.low, 2.0, 1e-9);
  EXPECT_NEAR(scale.high, 500.0, 1e-6);
}

TEST(RoundScale, CoversAPoint) {
  const Scale scale = round_scale(3.0, 3.0, 5);
  EXPECT_LT(scale.low, scale.high);
}

TEST(DrawLegend, BreaksIntoRows) {
  Svg svg;
  const LegendEntry entry{Symbol::kDot, "measured", "an entry of some length, twice"};
  const double one = draw_legend(svg, {entry});
  EXPECT_GT(draw_legend(svg, {entry, entry, entry}), one);
}

TEST(DrawColorBar, TakesASingleValue) {
  Svg svg;
  draw_color_bar(svg, 0.0, -60.0, -60.0);
  EXPECT_NE(svg.body.find("−60"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
