// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/port_turns.h"

#include <gtest/gtest.h>

#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

AntennaParameters antenna(const std::string& reader, const std::string& name, double dwell_s,
                          AirSharing sharing = AirSharing::kChannel) {
  auto radio = std::make_shared<RadioModel>();
  radio->gen2 = Gen2Reader{};
  radio->gen2->port_dwell_s = dwell_s;
  radio->sharing = sharing;
  AntennaParameters parameters;
  parameters.reader = reader;
  parameters.name = name;
  parameters.model = std::shared_ptr<const RadioModel>(radio);
  return parameters;
}

Time at_second(double seconds) { return time_from_seconds(seconds); }

TEST(PortCycles, LetEachReadersPortsTakeTurns) {
  const auto cycles =
      port_cycles({antenna("r", "a", 0.2), antenna("q", "z", 1.0), antenna("r", "b", 0.3)});
  ASSERT_EQ(cycles.size(), 2U);
  const PortCycle& of_r = cycles[1];
  EXPECT_EQ(antenna_on_turn(cycles[0], at_second(5.5)), "z");
  EXPECT_EQ(antenna_on_turn(of_r, at_second(0.0)), "a");
  EXPECT_EQ(antenna_on_turn(of_r, at_second(0.2)), "b");
  EXPECT_EQ(antenna_on_turn(of_r, at_second(0.499999)), "b");
  EXPECT_EQ(antenna_on_turn(of_r, at_second(0.5)), "a");
  EXPECT_EQ(antenna_on_turn(of_r, at_second(-0.1)), "b");
}

TEST(PortCycles, LetReadersThatShareTimeTakeTurnsTogether) {
  const auto cycles = port_cycles(
      {antenna("r", "a", 0.2, AirSharing::kTime), antenna("q", "z", 0.2, AirSharing::kTime)});
  ASSERT_EQ(cycles.size(), 1U);
  EXPECT_EQ(antenna_on_turn(cycles[0], at_second(0.1)), "a");
  EXPECT_EQ(antenna_on_turn(cycles[0], at_second(0.3)), "z");
}

TEST(PortCycles, PassOverAntennasWithoutInventory) {
  AntennaParameters plain;
  plain.name = "plain";
  EXPECT_TRUE(port_cycles({plain}).empty());
  EXPECT_FALSE(next_change({}, at_second(1.0)));
}

TEST(NextTurn, IsNowWhileItLastsAndElseWhenItBegins) {
  const PortCycle cycle = port_cycles({antenna("r", "a", 0.2), antenna("r", "b", 0.3)}).front();
  EXPECT_EQ(next_turn(cycle, "b", at_second(0.05)), at_second(0.2));
  EXPECT_EQ(next_turn(cycle, "b", at_second(0.3)), at_second(0.3));
  EXPECT_EQ(next_turn(cycle, "a", at_second(0.3)), at_second(0.5));
  EXPECT_FALSE(next_turn(cycle, "c", at_second(0.3)));
}

TEST(NextChange, IsTheFirstEndOfAnyTurn) {
  const auto cycles = port_cycles({antenna("r", "a", 0.2), antenna("r", "b", 0.3),
                                   antenna("q", "x", 0.15), antenna("q", "y", 0.15)});
  EXPECT_EQ(next_change(cycles, at_second(0.0)), at_second(0.15));
  EXPECT_EQ(next_change(cycles, at_second(0.15)), at_second(0.2));
  EXPECT_EQ(next_change(cycles, at_second(0.2)), at_second(0.3));
}

std::vector<std::pair<std::size_t, double>> others(const std::vector<AntennaParameters>& all,
                                                   const AntennaParameters& of, double time_s) {
  std::vector<std::pair<std::size_t, double>> found;
  for (const SendingAntenna& one : others_sending(all, of, at_second(time_s))) {
    found.emplace_back(one.number, one.time_share);
  }
  return found;
}

using Sending = std::vector<std::pair<std::size_t, double>>;

TEST(OthersSending, AreOtherReadersAntennasOnTurn) {
  const std::vector<AntennaParameters> all = {antenna("r", "a", 0.2), antenna("r", "b", 0.2),
                                              antenna("q", "y", 0.2), antenna("q", "z", 0.2)};
  EXPECT_EQ(others(all, all[0], 0.1), (Sending{{2, 1.0}}));
  EXPECT_EQ(others(all, all[0], 0.3), (Sending{{3, 1.0}}));
  EXPECT_EQ(others(all, all[3], 0.3), (Sending{{1, 1.0}}));
}

TEST(OthersSending, AreNoneWhereBothShareByTime) {
  const std::vector<AntennaParameters> all = {antenna("r", "a", 0.2, AirSharing::kTime),
                                              antenna("q", "z", 0.2, AirSharing::kTime),
                                              antenna("p", "c", 0.2)};
  EXPECT_EQ(others(all, all[0], 0.1), (Sending{{2, 1.0}}));
  EXPECT_EQ(others(all, all[2], 0.1), (Sending{{0, 1.0}}));
}

TEST(OthersSending, SendForPartOfTheirTimeWithoutTurns) {
  std::vector<AntennaParameters> all = {antenna("r", "a", 0.2), antenna("q", "y", 0.2),
                                        antenna("q", "z", 0.2)};
  for (std::size_t i : {1U, 2U}) {
    auto model = std::make_shared<RadioModel>(*physical(all[i]));
    model->effects.inventory = false;
    all[i].model = std::shared_ptr<const RadioModel>(model);
  }
  EXPECT_EQ(others(all, all[0], 0.1), (Sending{{1, 0.5}, {2, 0.5}}));
}

}  // namespace
}  // namespace tagfield
