// SPDX-License-Identifier: Apache-2.0
#include "tagfield/base/setting.h"

#include <gtest/gtest.h>

#include <limits>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

struct Lamp {
  double watts = 40.0;
  std::size_t bulbs = 2;
  bool on = true;
};

struct Lantern : Lamp {};

const std::vector<Setting<Lantern>>& table() {
  static const std::vector<Setting<Lantern>> all = {
      setting<Lantern>("watts", "W", "of each bulb", &Lamp::watts, kOverZero),
      setting<Lantern>("bulbs", "", "in it", &Lamp::bulbs, {1.0, false, 9.0}),
      setting<Lantern>("on", "whether it shines", &Lamp::on)};
  return all;
}

Lantern lantern_of(const std::vector<RawParameter>& parameters) {
  Lantern lantern;
  apply_settings(table(), parameters, lantern);
  return lantern;
}

std::string complaint_of(const std::string& key, const std::string& value) {
  return error_of([&] { lantern_of({{key, value, {"lamp.yaml", 7}}}); });
}

TEST(Setting, TakesValuesByTheirKeysTheLastOneCounts) {
  const Lantern lantern = lantern_of(
      {{"watts", "60", {}}, {"bulbs", "3", {}}, {"on", "false", {}}, {"watts", "6e1", {}}});
  EXPECT_EQ(lantern.watts, 60.0);
  EXPECT_EQ(lantern.bulbs, 3U);
  EXPECT_FALSE(lantern.on);
}

TEST(Setting, PassesOverKeysOfOthers) { EXPECT_EQ(lantern_of({{"oil", "1", {}}}).watts, 40.0); }

TEST(Setting, ComplainsWithThePlaceTheKeyAndTheRange) {
  EXPECT_EQ(complaint_of("watts", "0"), "lamp.yaml:7: watts must be over 0, is 0");
  EXPECT_EQ(complaint_of("bulbs", "0"),
            "lamp.yaml:7: bulbs must be at least 1 and at most 9, is 0");
  EXPECT_EQ(complaint_of("bulbs", "10"), "lamp.yaml:7: bulbs must be at most 9, is 10");
  EXPECT_EQ(complaint_of("bulbs", "2.5"), "lamp.yaml:7: bulbs is '2.5', expected a whole number");
  EXPECT_EQ(complaint_of("on", "maybe"), "lamp.yaml:7: on is 'maybe', expected true or false");
  EXPECT_EQ(complaint_of("watts", "nan"), "lamp.yaml:7: watts is 'nan', expected a finite number");
}

TEST(Setting, TellsWhatItIsFor) {
  Lantern dim;
  dim.watts = 2.5;
  const std::vector<SettingHelp> helps = helps_of(table(), dim);
  ASSERT_EQ(helps.size(), 3U);
  EXPECT_EQ(helps[0].otherwise, "2.5");
  EXPECT_EQ(helps[0].range, "over 0");
  EXPECT_EQ(helps[1].range, "at least 1 and at most 9");
  EXPECT_EQ(helps[2].unit, "true | false");
  EXPECT_EQ(helps[2].otherwise, "true");
  EXPECT_TRUE(has_key(helps, "on"));
  EXPECT_FALSE(has_key(helps, "oil"));
}

TEST(CheckSettings, FindsMembersOutOfTheirRange) {
  check_settings(table(), Lantern{});
  Lantern broken;
  broken.watts = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(error_of([&] { check_settings(table(), broken); }),
            "watts is 'nan', expected a finite number");
  broken.watts = -1.0;
  EXPECT_EQ(error_of([&] { check_settings(table(), broken); }), "watts must be over 0, is -1");
}

TEST(PlaceOf, IsThatOfTheLastParameterThatTheComplaintNames) {
  const std::vector<RawParameter> parameters = {
      {"watts", "1", {"a", 1}}, {"watts", "2", {"a", 2}}, {"on", "1", {"a", 3}}};
  EXPECT_EQ(place_of("watts are too many", parameters, {"b", 9}).line, 2);
  EXPECT_EQ(place_of("bulbs are too many", parameters, {"b", 9}).line, 9);
}

}  // namespace
}  // namespace tagfield
