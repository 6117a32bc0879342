// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/leave_one_out.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

AntennaSpec at(const std::string& name, double x) {
  AntennaSpec spec;
  spec.parameters.name = name;
  spec.X_PA = from_translation({x, 0.0, 1.0});
  return spec;
}

/// In the paper's model an antenna reads up to 7 m.
Scenario three_in_a_row() {
  Scenario scenario;
  scenario.duration_s = 0.5;
  scenario.antennas = {at("left", 0.0), at("middle", 2.0), at("right", 40.0)};
  for (const double x : {0.0, 1.0, 2.0, 40.0}) {
    TagSpec tag;
    tag.id = "tag" + std::to_string(scenario.tags.size());
    tag.motion = {{Time{}, from_translation({x, 1.0, 1.0})}};
    scenario.tags.push_back(tag);
  }
  return scenario;
}

TEST(LeaveOneOut, SaysWhatEachAntennaIsWorth) {
  const auto rows = leave_one_out(three_in_a_row(), 1, 2, {});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_DOUBLE_EQ(rows[0].read, 4.0);  // "middle" reads the same tags as "left".
  EXPECT_DOUBLE_EQ(rows[1].read, 4.0);
  EXPECT_EQ(rows[2].antenna, "right");
  EXPECT_DOUBLE_EQ(rows[2].read, 3.0);
}

TEST(TakeAway, GoesByNameAndPattern) {
  Scenario scenario = three_in_a_row();
  take_antennas_away({"*dd*", "left"}, scenario);
  ASSERT_EQ(scenario.antennas.size(), 1U);
  EXPECT_EQ(scenario.antennas[0].parameters.name, "right");
  EXPECT_THROW(take_antennas_away({"left"}, scenario), Error);
  EXPECT_THROW(take_antennas_away({"*"}, scenario), Error);
}

}  // namespace
}  // namespace tagfield
