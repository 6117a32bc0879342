// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/scenario/scenario.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

const std::string kTwoDoors =
    "duration_s: 1\nrobots:\n  - {name: cart, start: [0, 0, 0]}\n"
    "antennas:\n  - {name: a, reader: door_1, pose: [0, 0, 2]}\n"
    "  - {name: b, reader: door_2, pose: [4, 0, 2]}\n"
    "  - {name: c, reader: front, on: cart, pose: [0, 0, 1]}\n"
    "  - {name: d, reader: rear, on: cart, pose: [0, 0, 1]}\n"
    "tags:\n  - {id: t, position: [0, 0, 0]}\n";

std::string complaint_of(const std::string& zones) {
  Diagnostics unheard;
  try {
    load_scenario_with_world(folder_of_test().with("doors.yaml", kTwoDoors + zones), {}, unheard);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(Zones, AntennasOfOneRobotAreOneReader) {
  const Scenario scenario = load_scenario(folder_of_test().with("doors.yaml", kTwoDoors), {});
  EXPECT_EQ(reader_groups(scenario),
            (std::vector<std::string>{"door_1", "door_2", "cart", "cart"}));
  EXPECT_EQ(distinct(reader_groups(scenario)),
            (std::vector<std::string>{"door_1", "door_2", "cart"}));
}

TEST(Zones, HoldPlacesByTheirBox) {
  const Scenario scenario = load_scenario(
      folder_of_test().with(
          "doors.yaml",
          kTwoDoors + "zones:\n  - {name: low, box: [2, 2, 1, -2, -2, 0], readers: [door_1]}\n"
                      "  - {name: all, box: [-9, -9, 9, 9], readers: [cart]}\n"),
      {});
  ASSERT_EQ(scenario.zones.size(), 2U);
  EXPECT_EQ(zone_at(scenario.zones, {0.0, 0.0, 0.5}), 0U);
  EXPECT_EQ(zone_at(scenario.zones, {0.0, 0.0, 50.0}), 1U);
  EXPECT_EQ(zone_at(scenario.zones, {10.0, 0.0, 0.5}), 2U);
}

TEST(Zones, RefuseWhatNobodyReads) {
  EXPECT_NE(
      complaint_of("zones: [{name: z, box: [0, 0, 1, 1], readers: [door_3]}]\n")
          .find("doors.yaml:11: zone 'z' is for reader 'door_3', but no antenna belongs to it"),
      std::string::npos);
  EXPECT_NE(complaint_of("zones: [{name: z, box: [0, 0, 1, 1, 1]}]\n").find("has 5"),
            std::string::npos);
  EXPECT_NE(complaint_of("zones: [{name: z, box: [0, 0, 1, 1]}, {name: z, box: [0, 0, 1, 1]}]\n")
                .find("second zone 'z'"),
            std::string::npos);
}

}  // namespace
}  // namespace tagfield
