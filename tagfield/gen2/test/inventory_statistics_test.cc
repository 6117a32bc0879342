// SPDX-License-Identifier: Apache-2.0
// Random behaviour of inventories, compared with probability theory and published figures. Bounds
// of z are statistics::kNormalBound: one false alarm in a million per use.
#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/test/statistics.h"
#include "tagfield/gen2/test/inventories.h"

namespace tagfield {
namespace {

/// Rounds with fixed Q in which all `tags` always participate: those read are reset to A between
/// rounds, which are far enough apart for that.
InventoryCounts fresh_rounds(int q, int tags, int rounds, double decode_probability = 1.0) {
  InventorySettings settings = fixed_q(q);
  settings.round_overhead_s = 0.01;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(tags, decode_probability));
  bench.inventory.start(at(0.0));
  const std::int64_t wanted = std::int64_t{rounds} << static_cast<unsigned>(q);
  for (double time = 0.0; slots(bench.inventory.counts()) < wanted; time += 0.005) {
    for (const std::uint32_t tag : bench.read_until(time)) {
      bench.memories.set_flag(tag, settings.session, Flag::kA, at(time));
    }
  }
  EXPECT_EQ(slots(bench.inventory.counts()), wanted);
  return bench.inventory.counts();
}

/// Distribution of the number of boxes that contain exactly `held` balls, 0 or 1, when `boxes`
/// balls are thrown into `boxes` boxes.
struct Occupancy {
  double mean;
  double variance;
};

Occupancy occupancy(double boxes, int held) {
  const double n = boxes;
  const double one = held == 0 ? std::pow(1 - 1 / n, n) : std::pow(1 - 1 / n, n - 1);
  const double two = held == 0 ? std::pow(1 - 2 / n, n) : (n - 1) / n * std::pow(1 - 2 / n, n - 2);
  const double mean = n * one;
  const double pairs = n * (n - 1) * two;
  return {mean, pairs + mean - mean * mean};
}

void expect_sum(double sum, double draws, const Occupancy& law) {
  EXPECT_LT(std::abs(sum - draws * law.mean) / std::sqrt(draws * law.variance),
            statistics::kNormalBound);
}

class SlotEfficiency : public testing::TestWithParam<std::pair<int, double>> {};

TEST_P(SlotEfficiency, OfAsManyTagsAsSlotsFollowsTheBinomialLaw) {
  const auto [q, published] = GetParam();
  constexpr int kRounds = 1000;
  const int n = 1 << q;
  const InventoryCounts counts = fresh_rounds(q, n, kRounds);
  const Occupancy ones = occupancy(n, 1);
  EXPECT_NEAR(ones.mean / n, published, 5e-5);
  expect_sum(static_cast<double>(counts.read), kRounds, ones);
  expect_sum(static_cast<double>(counts.empty), kRounds, occupancy(n, 0));
  EXPECT_EQ(counts.collided, std::int64_t{kRounds} * n - counts.read - counts.empty);
}

INSTANTIATE_TEST_SUITE_P(Inventory, SlotEfficiency,
                         testing::Values(std::pair(4, 0.3798), std::pair(6, 0.3708),
                                         std::pair(8, 0.3686)));

TEST(Inventory, OneTagsSlotIsUniform) {
  // The number of empty slots before it in a frame of 8, over many rounds.
  InventorySettings settings = fixed_q(3);
  settings.round_overhead_s = 0.01;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(1));
  bench.inventory.start(at(0.0));
  std::vector<double> hits(8, 0.0);
  for (double time = 0.0; bench.inventory.counts().read < 8000; time += 0.00005) {
    if (bench.read_until(time).empty()) continue;
    hits[static_cast<std::size_t>(slots(bench.inventory.counts()) - 1) % 8] += 1.0;
    bench.memories.set_flag(0, settings.session, Flag::kA, at(time));
  }
  double chi_squared = 0.0;
  for (const double hit : hits) chi_squared += (hit - 1000.0) * (hit - 1000.0) / 1000.0;
  EXPECT_LT(chi_squared, 40.52);  // 7 degrees of freedom, one in a million.
}

TEST(Inventory, DecodeProbabilityIsTheShareOfReadsAmongRepliesAlone) {
  constexpr double kShare = 0.3;
  const InventoryCounts counts = fresh_rounds(0, 1, 5000, kShare);
  EXPECT_EQ(counts.read + counts.failed, 5000);
  expect_sum(static_cast<double>(counts.read), 5000, {kShare, kShare * (1 - kShare)});
}

TEST(Inventory, AdaptiveQGoesWhereEmptySlotsAreAsManyAsLostOnes) {
  // 256 tags, none of which is ever decoded: none leaves, and Q is balanced at e^-x = 1 - e^-x for
  // x tags per slot.
  InventoryBench bench(InventorySettings{});
  bench.inventory.set_field(at(0.0), alike(256, 0.0));
  bench.inventory.start(at(0.0));
  double sum = 0.0;
  constexpr int kSteps = 20000;
  for (int step = 0; step < kSteps; ++step) {
    bench.read_until(1.0 + 0.001 * step);
    sum += bench.inventory.q();
  }
  EXPECT_NEAR(sum / kSteps, std::log2(256 / std::log(2.0)), 0.3);
  // Qfp stays from 0 to 15, so the numbers of empty and other slots differ by 15/C at most.
  const InventoryCounts& counts = bench.inventory.counts();
  EXPECT_LT(std::abs(counts.empty - counts.failed - counts.collided), 75);
}

/// Minimum mean time per read if the reader knows how many tags are left and always uses the
/// optimal number of slots: minimized over x, the mean number of replies in a slot, which is
/// Poisson-distributed.
double best_time_per_read(const LinkSettings& link, Session session) {
  const double command = query_rep_s(link, session);
  double best = 1e9;
  for (double x = 0.1; x < 3.0; x += 0.001) {
    const double empty = std::exp(-x);
    const double read = x * empty;
    const double time = empty * empty_slot_s(link) + read * read_slot_s(link) +
                        (1 - empty - read) * collided_slot_s(link) + command;
    best = std::min(best, time / read);
  }
  return best;
}

TEST(Inventory, AdaptiveQReadsNearlyAsFastAsCanBe) {
  InventorySettings settings;
  settings.session = Session::kS2;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(2000));
  bench.inventory.start(at(0.0));
  std::vector<Singulation> out;
  bench.inventory.run_until(at(60.0), out);
  ASSERT_EQ(out.size(), 2000U);
  // Without the initial search for Q and the last few tags.
  const double measured = to_seconds(out[1899].stamp - out[99].stamp) / 1800.0;
  const double best = best_time_per_read({}, Session::kS2);
  EXPECT_GT(measured, 0.97 * best);  // Random error: 1800 reads of 2.7 ± 2.1 slots each.
  EXPECT_LT(measured, 1.1 * best);
}

TEST(Inventory, AdaptiveQFollowsThePopulation) {
  // Annex D balances empty slots and collisions: for Poisson with x replies per slot, at e^x = 2 +
  // x.
  constexpr double kBalance = 1.146;
  EXPECT_NEAR(std::exp(kBalance), 2.0 + kBalance, 1e-3);
  InventorySettings settings;
  settings.session = Session::kS2;
  InventoryBench bench(settings);
  bench.inventory.set_field(at(0.0), alike(2000));
  bench.inventory.start(at(0.0));
  std::size_t read = 0;
  std::vector<double> differences;
  for (double time = 0.0; read < 1900; time += 0.005) {
    read += bench.read_until(time).size();
    if (read <= 100) continue;
    const double balanced = std::log2((2000.0 - static_cast<double>(read)) / kBalance);
    differences.push_back(bench.inventory.q() - balanced);
    EXPECT_NEAR(differences.back(), 0.0, 2.5);
  }
  EXPECT_NEAR(statistics::mean(differences), 0.0, 0.2);
}

// Impinj's Indy RS500 (data sheet revision 1.1, table 5-12): 130, 35 and 50 reads/s. Its link and
// settings are not stated; docs/gen2.md lists which of them give these rates and which do not.
double rs500_rate(int q, int tags) {
  LinkSettings link;
  link.pilot = false;
  InventorySettings settings = fixed_q(q);
  settings.carrier_off_between_rounds = true;
  settings.slot_overhead_s = 3.05e-3;
  InventoryBench bench(settings, 1, 1, link);
  bench.inventory.set_field(at(0.0), alike(tags));
  bench.inventory.start(at(0.0));
  return static_cast<double>(bench.read_until(200.0).size()) / 200.0;
}

TEST(Inventory, IndyRs500sRatesComeWithin15PercentWhereTheyCan) {
  EXPECT_NEAR(rs500_rate(0, 1), 130.0, 0.15 * 130.0);
  EXPECT_NEAR(rs500_rate(3, 1), 35.0, 0.15 * 35.0);
  EXPECT_NEAR(rs500_rate(3, 16), 50.0, 0.15 * 50.0);
}

}  // namespace
}  // namespace tagfield
