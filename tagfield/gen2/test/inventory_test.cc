// SPDX-License-Identifier: Apache-2.0
#include "tagfield/gen2/inventory.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>

#include "tagfield/base/test/error_text.h"
#include "tagfield/gen2/test/inventories.h"

namespace tagfield {
namespace {

using Tags = std::vector<std::uint32_t>;

// --- One slot ------------------------------------------------------------------------------------

TEST(Inventory, OneTagsFirstReadIsWhereTheStandardsTimesPutIt) {
  InventorySettings settings = fixed_q(0);
  settings.round_overhead_s = 3e-3;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(1.0));
  std::vector<Singulation> out;
  // Power-up and overhead, then Query (185.333 + 13 data-0 + 9 data-1), 1451.5 until the EPC and
  // the rest of the slot, in microseconds: see link_timing_test.cc.
  const double query = 1.0 + (1500 + 3000 + 185.333333 + 13 * 25.0 + 9 * 37.5) * 1e-6;
  bench.inventory.run_until(at(query + 3907.4e-6), out);
  EXPECT_TRUE(out.empty());
  bench.inventory.run_until(at(query + 3907.6e-6), out);
  ASSERT_EQ(out.size(), 1U);
  EXPECT_NEAR(to_seconds(out[0].stamp), query + 1451.5e-6, 2e-9);
  EXPECT_EQ(bench.inventory.counts().read, 1);
}

TEST(Inventory, DualTargetThroughputOfOneTagIsTheSumOfItsSlots) {
  InventorySettings settings = fixed_q(0);
  settings.target = Target::kAlternate;
  settings.slot_overhead_s = 1e-3;
  settings.read_overhead_s = 2e-3;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  // A round that reads the tag, and one that finds none left; 847.833 per Query.
  const double cycle = (2 * 847.833333 + 3907.5 + 125.0 + 2 * 1000.0 + 2000.0) * 1e-6;
  EXPECT_NEAR(static_cast<double>(bench.read_until(100.0).size()), 100.0 / cycle, 2.0);
}

TEST(Inventory, ASlotIsFinishedAtItsEndAndBegunAfterItsBeginning) {
  InventoryBench bench(fixed_q(0));
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(1.5e-3).empty());
  bench.inventory.set_field(at(1.5e-3), alike(1));  // In time for the Query.
  const double end = 1.5e-3 + (185.333333 + 13 * 25.0 + 9 * 37.5 + 3907.5) * 1e-6;
  EXPECT_TRUE(bench.read_until(end - 1e-9).empty());
  EXPECT_EQ(bench.read_until(end), Tags{0});
}

TEST(Inventory, AdaptiveQInAnEmptyFieldTakesTheTimeOfItsCommands) {
  InventoryBench bench(InventorySettings{});
  bench.inventory.start(at(0.0));
  bench.read_until(100.0);
  // Qfp decreases from 4 by 0.2 per slot: 3 slots with Q 4, 5 with Q 3, and then a whole frame with
  // Q 2, which is empty: back to 4. Query, 2 QueryAdjusts, 9 QueryReps and 12 empty slots.
  const double cycle = (847.833333 + 2 * 375.0 + 9 * 200.0 + 12 * 125.0) * 1e-6;
  EXPECT_NEAR(static_cast<double>(bench.inventory.counts().rounds), 100.0 / cycle, 1.5);
}

TEST(Inventory, TheStrongestIsCapturedFromItsThresholdOn) {
  // -50 dBm against the sum of two at -58: 4.99 dB.
  const std::vector<TagOnAir> tags = {{0, -58.0, 1.0}, {1, -50.0, 1.0}, {2, -58.0, 1.0}};
  const auto counts = [&](std::optional<double> capture_db) {
    InventorySettings settings = fixed_q(0);
    settings.capture_db = capture_db;
    InventoryBench bench(settings);
    bench.inventory.set_field(at(0.0), tags);
    bench.inventory.start(at(0.0));
    const Tags read = bench.read_until(1.0);
    EXPECT_EQ(read, bench.inventory.counts().captured == 1 ? Tags{1} : Tags{});
    return bench.inventory.counts();
  };
  EXPECT_EQ(counts(4.98).captured, 1);
  EXPECT_EQ(counts(5.0).captured, 0);
  EXPECT_EQ(counts(std::nullopt).captured, 0);
  EXPECT_GT(counts(std::nullopt).collided, 100);
}

TEST(Inventory, WithoutTagsAllSlotsAreEmpty) {
  InventoryBench bench(InventorySettings{});
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(1.0).empty());
  EXPECT_GT(bench.inventory.counts().empty, 1000);
  EXPECT_EQ(slots(bench.inventory.counts()), bench.inventory.counts().empty);
}

// --- Tags that come and go within a round --------------------------------------------------------

TEST(Inventory, AReadFailsWhoseTagGoesBeforeItsEnd) {
  InventoryBench bench(fixed_q(0));
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(0.004).empty());  // During the first slot.
  bench.inventory.set_field(at(0.004), {});
  EXPECT_TRUE(bench.read_until(0.1).empty());
  EXPECT_EQ(bench.inventory.counts().failed, 1);
  EXPECT_EQ(bench.memories.flag(0, Session::kS0, at(0.1)), Flag::kA);
}

TEST(Inventory, ACaptureFailsWhoseTagGoesBeforeItsEnd) {
  InventorySettings settings = fixed_q(0);
  settings.capture_db = 6.0;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), {{0, -50.0, 1.0}, {1, -60.0, 1.0}});
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(0.004).empty());
  bench.inventory.set_field(at(0.004), {{1, -60.0, 1.0}});
  EXPECT_EQ(bench.read_until(0.1), Tags{1});
  EXPECT_EQ(bench.inventory.counts().captured, 0);
  EXPECT_EQ(bench.inventory.counts().collided, 1);
}

TEST(Inventory, ASlotThatIsCutOffComesToNothing) {
  InventoryBench bench(fixed_q(0));
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  EXPECT_TRUE(bench.read_until(0.004).empty());
  bench.inventory.stop(at(0.004));
  bench.inventory.start(at(0.005));
  EXPECT_TRUE(bench.read_until(0.010).empty());
  EXPECT_EQ(slots(bench.inventory.counts()), 0);
  EXPECT_EQ(bench.read_until(0.013), Tags{0});
}

TEST(Inventory, ANewcomerJoinsWithTheNextQuery) {
  InventoryBench bench(fixed_q(8));  // A frame of 256 slots, most of them empty.
  bench.inventory.start(at(0.0));
  bench.read_until(0.01);
  bench.inventory.set_field(at(0.01), alike(30));
  const double frame = 0.0015 + 848e-6 + 256 * 125e-6 + 255 * 200e-6;
  EXPECT_TRUE(bench.read_until(frame - 0.001).empty());
  EXPECT_EQ(bench.inventory.counts().rounds, 1);
  EXPECT_FALSE(bench.read_until(2 * frame).empty());
}

TEST(Inventory, ASlotsNextTagIsReadThoughTheOldOneWas) {
  InventoryBench bench(in_session(Session::kS2));
  bench.inventory.set_field(at(0.0), alike(2));
  bench.inventory.start(at(0.0));
  EXPECT_EQ(bench.read_until(1.0).size(), 2U);
  bench.inventory.forget(1);
  bench.memories.forget(1);
  EXPECT_TRUE(bench.read_until(2.0).empty());
  bench.inventory.set_field(at(2.0), alike(2));
  EXPECT_EQ(bench.read_until(3.0), Tags{1});
}

// --- Time and seeds ------------------------------------------------------------------------------

RC_GTEST_PROP(Inventory, PiecesOfTimeGiveWhatTheWholeGives, ()) {
  InventorySettings settings;
  settings.session = *rc::gen::element(Session::kS0, Session::kS1, Session::kS2);
  settings.target = *rc::gen::element(Target::kA, Target::kAlternate);
  settings.adaptive_q = *rc::gen::arbitrary<bool>();
  settings.start_q = *rc::gen::inRange(0, 7);
  settings.slot_overhead_s = *rc::gen::element(0.0, 1e-3);
  settings.carrier_off_between_rounds = *rc::gen::arbitrary<bool>();
  const std::vector<TagOnAir> tags = alike(*rc::gen::inRange(0, 40), 0.8);
  const auto count = static_cast<std::size_t>(*rc::gen::inRange(1, 30));
  const auto pieces = *rc::gen::container<std::vector<int>>(count, rc::gen::inRange(0, 200'000));

  InventoryBench whole(settings);
  InventoryBench parts(settings);
  std::vector<Singulation> expected;
  std::vector<Singulation> found;
  Time time{};
  for (InventoryBench* bench : {&whole, &parts}) {
    bench->inventory.set_field(time, tags);
    bench->inventory.start(time);
  }
  for (const int piece : pieces) {
    time += std::chrono::microseconds(piece);
    parts.inventory.run_until(time, found);
  }
  whole.inventory.run_until(time, expected);
  RC_ASSERT(found == expected);
  RC_ASSERT(slots(parts.inventory.counts()) == slots(whole.inventory.counts()));
  RC_ASSERT(std::is_sorted(found.begin(), found.end(),
                           [](const auto& a, const auto& b) { return a.stamp < b.stamp; }));
}

Tags reads_with(std::uint64_t seed, std::uint64_t key) {
  InventoryBench bench(in_session(Session::kS2), seed, key);
  bench.inventory.set_field(at(0.0), alike(100));
  bench.inventory.start(at(0.0));
  return bench.read_until(10.0);
}

TEST(Inventory, TheSameSeedAndKeyGiveTheSameReads) {
  EXPECT_EQ(reads_with(1, 1), reads_with(1, 1));
  EXPECT_NE(reads_with(1, 1), reads_with(2, 1));
  EXPECT_NE(reads_with(1, 1), reads_with(1, 2));
}

TEST(Inventory, TimeDoesNotGoBack) {
  InventoryBench bench(InventorySettings{});
  bench.inventory.start(at(2.0));
  const std::string back = "an inventory at 2 s cannot go back to 1 s";
  EXPECT_EQ(error_of([&] { bench.read_until(1.0); }), back);
  EXPECT_EQ(error_of([&] { bench.inventory.stop(at(1.0)); }), back);
  EXPECT_EQ(error_of([&] { bench.inventory.set_field(at(1.0), {}); }), back);
}

TEST(Inventory, BadSettingsAreRefused) {
  EXPECT_THROW(InventoryBench(fixed_q(16)), Error);
  LinkSettings link;
  link.tari_s = 1.0;
  EXPECT_THROW(InventoryBench(fixed_q(4), 1, 1, link), Error);
}

}  // namespace
}  // namespace tagfield
