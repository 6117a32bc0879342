// SPDX-License-Identifier: Apache-2.0
#include "tagfield/experiment/inventory.h"

#include <gtest/gtest.h>

#include "tagfield/base/units.h"
#include "tagfield/experiment/experiment.h"

namespace tagfield {
namespace {

AntennaSpec antenna(const std::string& name, const std::string& reader, const Eigen::Vector3d& p) {
  AntennaSpec spec;
  spec.parameters.name = name;
  spec.parameters.reader = reader;
  spec.X_PA = from_translation(p);
  return spec;
}

TagSpec tag(const std::string& id, const Eigen::Vector3d& p) {
  TagSpec spec;
  spec.id = id;
  spec.motion = {{Time{}, from_translation(p)}};
  return spec;
}

TagRead read(double time_s, const std::string& antenna, const std::string& tag) {
  TagRead one;
  one.stamp = time_from_seconds(time_s);
  one.antenna = antenna;
  one.tag = tag;
  return one;
}

/// A recording with the tags where they appear.
Recording recorded(const Scenario& scenario, std::vector<TagRead> reads) {
  Recording recording;
  recording.reads = std::move(reads);
  for (const TagSpec& tag : scenario.tags) {
    recording.truth.tag_positions.push_back({Time{}, tag.id, tag.motion.front().X_WB.translation});
  }
  return recording;
}

/// Two doors 10 m apart, two antennas at the first.
Scenario two_doors() {
  Scenario scenario;
  scenario.duration_s = 2.0;
  scenario.antennas = {antenna("w1", "west", {0, 0, 2}), antenna("w2", "west", {1, 0, 2}),
                       antenna("e1", "east", {10, 0, 2})};
  scenario.tags = {tag("a", {0, 1, 0.5}), tag("b", {9, 1, 0.5}), tag("c", {9, 2, 1.5}),
                   tag("d", {0, 2, 1.5})};
  return scenario;
}

TEST(Inventory, TellsWhoWasReadByWhomAndWhen) {
  const std::vector<TagRead> reads = {read(0.1, "w1", "a"), read(0.2, "w2", "a"),
                                      read(0.4, "w1", "b"), read(0.6, "e1", "b"),
                                      read(0.8, "w2", "b"), read(1.0, "e1", "c")};
  const InventorySummary inventory = inventory_of(two_doors(), recorded(two_doors(), reads), 2.0);
  EXPECT_EQ(inventory.tags, 4U);
  EXPECT_DOUBLE_EQ(inventory.read, 3.0);
  EXPECT_DOUBLE_EQ(inventory.reads, 6.0);
  EXPECT_DOUBLE_EQ(*inventory.median_reads, 2.0);
  ASSERT_EQ(inventory.reached.size(), 3U);
  EXPECT_NEAR(*inventory.reached[0].time_s, 0.4, 1e-9);  // Two of four.
  EXPECT_FALSE(inventory.reached[1].time_s);
  ASSERT_EQ(inventory.readers.size(), 2U);
  EXPECT_DOUBLE_EQ(inventory.readers[0].tags, 2.0);
  EXPECT_DOUBLE_EQ(inventory.readers[0].only, 1.0);
  EXPECT_DOUBLE_EQ(inventory.antennas[1].reads, 2.0);
  // b belongs to the east door, and both antennas of the west door are one reader.
  ASSERT_EQ(inventory.zones.size(), 2U);
  EXPECT_EQ(inventory.zones[1].zone, "near east");
  EXPECT_DOUBLE_EQ(inventory.zones[1].crossed, 1.0);
  EXPECT_DOUBLE_EQ(inventory.zones[1].cross[0].reads, 2.0);
  EXPECT_DOUBLE_EQ(inventory.zones[1].read_by_own, 2.0);
  EXPECT_DOUBLE_EQ(inventory.zones[0].crossed, 0.0);
  ASSERT_EQ(inventory.levels.size(), 2U);
  EXPECT_EQ(inventory.levels[1].tags, 2U);
  EXPECT_DOUBLE_EQ(inventory.levels[1].read, 1.0);
}

TEST(Inventory, GoesByTheScenariosZones) {
  Scenario scenario = two_doors();
  scenario.zones = {{"all",
                     Eigen::AlignedBox3d(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(11, 3, 1)),
                     {"west", "east"},
                     {}}};
  const InventorySummary inventory =
      inventory_of(scenario, recorded(scenario, {read(0.1, "w1", "b")}), 2.0);
  ASSERT_EQ(inventory.zones.size(), 2U);
  EXPECT_EQ(inventory.zones[0].tags, 2U);
  EXPECT_DOUBLE_EQ(inventory.zones[0].crossed, 0.0);
  EXPECT_EQ(inventory.zones[1].zone, "elsewhere");
}

TEST(Inventory, WhatIsReadInAZoneWithoutReadersIsCrossRead) {
  Scenario scenario = two_doors();
  scenario.zones = {
      {"parked", Eigen::AlignedBox3d(Eigen::Vector3d(8, 0, 0), Eigen::Vector3d(11, 3, 3)), {}, {}}};
  const InventorySummary inventory = inventory_of(
      scenario,
      recorded(scenario, {read(0.1, "w1", "b"), read(0.2, "e1", "b"), read(0.3, "w1", "a")}), 2.0);
  ASSERT_EQ(inventory.zones.size(), 2U);
  EXPECT_EQ(inventory.zones[0].tags, 2U);
  EXPECT_DOUBLE_EQ(inventory.zones[0].read, 1.0);
  EXPECT_DOUBLE_EQ(inventory.zones[0].read_by_own, 0.0);
  EXPECT_DOUBLE_EQ(inventory.zones[0].crossed, 1.0);
  ASSERT_EQ(inventory.zones[0].cross.size(), 2U);
  EXPECT_DOUBLE_EQ(inventory.zones[0].cross[0].reads, 1.0);
  EXPECT_EQ(inventory.zones[1].zone, "elsewhere");
  EXPECT_DOUBLE_EQ(inventory.zones[1].crossed, 0.0);
}

/// A cart that drives from the east door to the west door with a tag on it, mounted at its origin.
Scenario cart_between_doors() {
  Scenario scenario = two_doors();
  scenario.duration_s.reset();
  RobotSpec cart;
  cart.name = "cart";
  cart.start = {10.0, 1.0, kPi};
  cart.waypoints = {{0.0, 1.0}};
  scenario.robots = {cart};
  scenario.tags = {tag("on_cart", {0, 0, 1})};
  scenario.tags[0].on = "cart";
  return scenario;
}

InventorySummary inventory_of_run(const Scenario& scenario) {
  Diagnostics diagnostics;
  return *summarize(scenario, run_seeds(scenario, 1, 1, {}, diagnostics), 1.0, diagnostics)
              .inventory;
}

TEST(Inventory, ATagOnARobotBelongsWhereItAppears) {
  Scenario scenario = cart_between_doors();
  using Box = Eigen::AlignedBox3d;
  scenario.zones = {
      {"in the west", Box(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(1, 3, 2)), {}, {}},
      {"in the east", Box(Eigen::Vector3d(9, -1, 0), Eigen::Vector3d(11, 3, 2)), {}, {}}};
  const InventorySummary inventory = inventory_of_run(scenario);
  EXPECT_EQ(inventory.zones[0].tags, 0U);
  EXPECT_EQ(inventory.zones[1].tags, 1U);
}

TEST(Inventory, WithoutZonesTheReaderCountsThatATagComesNearest) {
  // It begins at the east door's antenna, 1 m aside of it, and ends below the west door's.
  Scenario scenario = cart_between_doors();
  scenario.robots[0].waypoints = {{0.5, 0.0}};
  const InventorySummary inventory = inventory_of_run(scenario);
  ASSERT_EQ(inventory.zones.size(), 2U);
  EXPECT_EQ(inventory.zones[0].zone, "near west");
  EXPECT_EQ(inventory.zones[0].tags, 1U);
  EXPECT_EQ(inventory.zones[1].tags, 0U);
}

TEST(Inventory, IsChosenWhereNothingCanBeLocated) {
  Scenario scenario = two_doors();
  EXPECT_NE(why_inventory_alone(scenario).find("all antennas stand still"), std::string::npos);
  scenario.localization.method = "fixed";
  EXPECT_EQ(why_inventory_alone(scenario), "");
  scenario.localization.method = kNoLocalization;
  EXPECT_NE(why_inventory_alone(scenario), "");
  scenario.localization.method = "hyperbola";
  scenario.antennas[0].lift.travel_m = 1.0;
  EXPECT_EQ(why_inventory_alone(scenario), "");
}

TEST(Inventory, OfARunHasNoPlaces) {
  const Scenario scenario = two_doors();
  Diagnostics diagnostics;
  const std::vector<SeedRun> runs = run_seeds(scenario, 1, 2, {}, diagnostics);
  const Summary summary = summarize(scenario, runs, 1.0, diagnostics);
  EXPECT_EQ(summary.method, "none");
  ASSERT_TRUE(summary.inventory);
  // In the paper's model all tags within 7 m are read.
  EXPECT_DOUBLE_EQ(summary.inventory->read, 4.0);
  EXPECT_EQ(count(summary, Verdict::kLocated), 0U);
}

}  // namespace
}  // namespace tagfield
