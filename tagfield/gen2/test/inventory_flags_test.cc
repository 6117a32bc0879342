// SPDX-License-Identifier: Apache-2.0
// Which tags an inventory reads again, and when: sessions, targets, absence, and antennas that
// share tags.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "tagfield/gen2/test/inventories.h"

namespace tagfield {
namespace {

using Tags = std::vector<std::uint32_t>;

TEST(Inventory, InS2EachTagIsReadOnceUntilItsFlagFallsBack) {
  InventoryBench bench(in_session(Session::kS2));
  bench.inventory.set_field(at(0.0), alike(200));
  bench.inventory.start(at(0.0));
  Tags read = bench.read_until(60.0);
  std::sort(read.begin(), read.end());
  Tags all(200);
  std::iota(all.begin(), all.end(), 0U);
  EXPECT_EQ(read, all);
  bench.inventory.stop(at(60.0));
  bench.inventory.start(at(69.9));
  EXPECT_TRUE(bench.read_until(80.0).empty());
  bench.inventory.stop(at(80.0));
  bench.inventory.start(at(90.1));
  EXPECT_EQ(bench.read_until(100.0).size(), 200U);
}

TEST(Inventory, InS1EachTagIsReadAgainOnceItsPersistenceIsOver) {
  InventoryBench bench(in_session(Session::kS1));
  bench.inventory.set_field(at(0.0), alike(20));
  bench.inventory.start(at(0.0));
  std::vector<Singulation> out;
  bench.inventory.run_until(at(30.0), out);
  std::map<std::uint32_t, Time> last;
  for (const Singulation& read : out) {
    const auto [place, first] = last.try_emplace(read.tag, read.stamp);
    // 2 s from the end of the reply, plus the round in progress and a slot in the next.
    if (first) continue;
    EXPECT_GT(to_seconds(read.stamp - place->second), 2.0);
    EXPECT_LT(to_seconds(read.stamp - place->second), 2.3);
    place->second = read.stamp;
  }
  EXPECT_EQ(last.size(), 20U);
  EXPECT_GE(out.size(), 13U * 20U);
}

TEST(Inventory, DualTargetReadsAllByTurns) {
  InventorySettings settings = in_session(Session::kS2);
  settings.target = Target::kAlternate;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(50));
  bench.inventory.start(at(0.0));
  const Tags read = bench.read_until(20.0);
  ASSERT_GT(read.size(), 500U);
  for (std::size_t begin = 0; begin + 50 <= read.size(); begin += 50) {
    const auto from = read.begin() + static_cast<std::ptrdiff_t>(begin);
    EXPECT_EQ(std::set<std::uint32_t>(from, from + 50).size(), 50U);
  }
}

TEST(Inventory, TargetBAsksForThoseInB) {
  InventorySettings settings = in_session(Session::kS3);
  settings.target = Target::kB;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(5));
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(1.0).empty());
  bench.memories.set_flag(3, Session::kS3, Flag::kB, at(1.0));
  EXPECT_EQ(bench.read_until(2.0), Tags{3});
  EXPECT_EQ(bench.inventory.target(), Flag::kB);
}

/// Tag 0 is read in the first second; returns how often in the next two, if it is absent for `away`
/// seconds.
std::size_t reads_after_absence(Session session, double away) {
  InventoryBench bench(in_session(session));
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  EXPECT_EQ(bench.read_until(1.0).size(), 1U);
  bench.inventory.set_field(at(1.0), {});
  EXPECT_TRUE(bench.read_until(1.0 + away).empty());
  bench.inventory.set_field(at(1.0 + away), alike(1));
  return bench.read_until(1.9 + away).size();
}

TEST(Inventory, WhoComesBackIsReadAgainAsItsSessionRemembers) {
  EXPECT_EQ(reads_after_absence(Session::kS0, 0.001), 1U);
  EXPECT_EQ(reads_after_absence(Session::kS1, 0.05), 0U);
  EXPECT_EQ(reads_after_absence(Session::kS1, 2.0), 1U);
  EXPECT_EQ(reads_after_absence(Session::kS2, 9.9), 0U);
  EXPECT_EQ(reads_after_absence(Session::kS2, 10.1), 1U);
}

TEST(Inventory, CarrierOffBetweenRoundsStartsS0Anew) {
  InventorySettings settings = fixed_q(0);
  settings.carrier_off_between_rounds = true;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  const double cycle = (1500.0 + 847.833333 + 3907.5) * 1e-6;
  EXPECT_NEAR(static_cast<double>(bench.read_until(50.0).size()), 50.0 / cycle, 2.0);
}

// --- Antennas ------------------------------------------------------------------------------------

TEST(Inventory, AntennasShareTheTagsMemory) {
  TagMemories memories;
  const InventorySettings settings = in_session(Session::kS2);
  Inventory first({}, settings, memories, 1, 1);
  Inventory second({}, settings, memories, 1, 2);
  std::vector<Singulation> out;
  first.set_field(at(0.0), alike(3));
  second.set_field(at(0.0), alike(6));
  first.start(at(0.0));
  first.run_until(at(1.0), out);
  EXPECT_EQ(out.size(), 3U);
  first.stop(at(1.0));
  EXPECT_FALSE(first.on());
  out.clear();
  second.start(at(1.0));
  second.run_until(at(2.0), out);
  std::set<std::uint32_t> rest;
  for (const Singulation& read : out) rest.insert(read.tag);
  EXPECT_EQ(rest, (std::set<std::uint32_t>{3, 4, 5}));
  EXPECT_EQ(out.size(), 3U);
}

TEST(Inventory, InS0ASwitchForgetsUnlessAnotherAntennaGivesPower) {
  TagMemories memories;
  const InventorySettings settings = in_session(Session::kS0);
  Inventory first({}, settings, memories, 1, 1);
  Inventory second({}, settings, memories, 1, 2);
  std::vector<Singulation> out;
  first.set_field(at(0.0), alike(2));
  second.set_field(at(0.0), {{1, -50.0, 1.0}});
  first.start(at(0.0));
  second.start(at(0.0));
  first.run_until(at(1.0), out);
  first.stop(at(1.0));
  out.clear();
  first.start(at(1.0));
  first.run_until(at(2.0), out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_EQ(out[0].tag, 0U);
}

TEST(Inventory, WhatIsOffReadsNothing) {
  InventoryBench bench(InventorySettings{});
  bench.inventory.set_field(at(0.0), alike(3));
  EXPECT_TRUE(bench.read_until(1.0).empty());
  EXPECT_FALSE(bench.memories.powered(0));
  bench.inventory.start(at(1.0));
  EXPECT_TRUE(bench.memories.powered(0));
  bench.inventory.stop(at(1.004));  // During the first round.
  EXPECT_FALSE(bench.memories.powered(0));
  EXPECT_TRUE(bench.read_until(2.0).empty());
  bench.inventory.stop(at(2.0));
  bench.inventory.start(at(3.0));
  EXPECT_EQ(bench.read_until(4.0).size(), 3U);
}

}  // namespace
}  // namespace tagfield
