// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/channel_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "tagfield/base/error.h"

namespace tagfield {
namespace {

Time at(double seconds) { return time_from_seconds(seconds); }

TEST(KnownPlans, AreWithinTheirBandsAndAsManyAsTheRegulationsSay) {
  for (const ChannelPlan& plan : known_plans()) EXPECT_NO_THROW(check(plan)) << plan.name;
  EXPECT_EQ(known_plan("fcc").carriers_hz.size(), 50U);
  EXPECT_DOUBLE_EQ(known_plan("fcc").carriers_hz.back(), 927.25e6);
  EXPECT_EQ(known_plan("etsi_low").carriers_hz,
            (std::vector<double>{865.7e6, 866.3e6, 866.9e6, 867.5e6}));
  EXPECT_DOUBLE_EQ(known_plan("china").carriers_hz.back(), 924.375e6);
}

TEST(KnownPlans, OfTheFccLimitsThePowerIntoTheAntenna) {
  // 47 CFR 15.247(b)(2): 1 W with at least 50 hopping channels, else 0.25 W.
  ChannelPlan plan = known_plan("fcc");
  ASSERT_TRUE(max_conducted_dbm(plan));
  EXPECT_NEAR(*max_conducted_dbm(plan), 30.0, 1e-9);
  plan.carriers_hz.pop_back();
  EXPECT_NEAR(*max_conducted_dbm(plan), 23.979, 1e-3);
  EXPECT_FALSE(max_conducted_dbm(known_plan("etsi_low")));
  EXPECT_FALSE(max_conducted_dbm(fixed_plan(915e6)));
}

TEST(ChannelAt, VisitsEachChannelOnceACycleForItsDwell) {
  const ChannelPlan& plan = known_plan("fcc");
  std::set<std::size_t> seen;
  for (int i = 0; i < 50; ++i) {
    const std::size_t channel = channel_at(plan, at(0.4 * i), 7, 1);
    EXPECT_EQ(channel_at(plan, at(0.4 * i + 0.399), 7, 1), channel);
    EXPECT_EQ(channel_at(plan, at(0.4 * i + 20.0), 7, 1), channel);
    seen.insert(channel);
  }
  EXPECT_EQ(seen.size(), 50U);
}

TEST(ChannelAt, GoesOnBeforeTheEpoch) {
  const ChannelPlan& plan = known_plan("etsi_low");
  for (double t = -40.0; t < 0.0; t += 0.5) {
    EXPECT_EQ(channel_at(plan, at(t), 3, 1), channel_at(plan, at(t + 48.0), 3, 1)) << t;
  }
}

TEST(ChannelAt, KeepsReadersWithTurnsApart) {
  const ChannelPlan& plan = known_plan("etsi_high");
  for (double t = 0.0; t < 30.0; t += 0.7) {
    std::set<std::size_t> used;
    for (std::size_t turn = 0; turn < 3; ++turn) used.insert(channel_at(plan, at(t), 3, 9, turn));
    EXPECT_EQ(used.size(), 3U);
  }
}

TEST(ChannelAt, HasAnOrderOfItsOwnForEachSeedAndReader) {
  const ChannelPlan& plan = known_plan("fcc");
  const auto order = [&](std::uint64_t key, std::uint64_t seed) {
    std::vector<std::size_t> channels;
    for (int i = 0; i < 50; ++i) channels.push_back(channel_at(plan, at(0.4 * i), key, seed));
    return channels;
  };
  EXPECT_EQ(order(1, 1), order(1, 1));
  EXPECT_NE(order(1, 1), order(1, 2));
  EXPECT_NE(order(1, 1), order(2, 1));
}

std::string complaint(const ChannelPlan& plan) {
  try {
    check(plan);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(CheckPlan, NamesTheCarrierOutsideItsBand) {
  ChannelPlan plan = known_plan("etsi_low");
  plan.carriers_hz.push_back(915e6);
  EXPECT_EQ(complaint(plan), "carrier 915 MHz is outside the plan's band, 865 to 868 MHz");
  EXPECT_NE(complaint(fixed_plan(-1.0)), "");
  EXPECT_EQ(complaint(fixed_plan(915e6)), "");
  plan = fixed_plan(915e6);
  plan.dwell_s = 0.0;
  EXPECT_NE(complaint(plan), "");
  plan.carriers_hz.clear();
  EXPECT_NE(complaint(plan), "");
}

}  // namespace
}  // namespace tagfield
