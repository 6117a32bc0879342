// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/port_turns.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

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

std::vector<AntennaParameters> hopping(const std::vector<double>& port_dwells_s, int channels,
                                       double channel_dwell_s) {
  std::vector<AntennaParameters> antennas;
  for (const double dwell_s : port_dwells_s) {
    antennas.push_back(antenna("r", std::to_string(antennas.size()), dwell_s));
    auto model = std::make_shared<RadioModel>(*physical(antennas.back()));
    model->effects.hopping = true;
    model->plan.carriers_hz.clear();
    for (int i = 0; i < channels; ++i) model->plan.carriers_hz.push_back(902.75e6 + 0.5e6 * i);
    model->plan.dwell_s = channel_dwell_s;
    antennas.back().model = std::shared_ptr<const RadioModel>(model);
  }
  return antennas;
}

/// Time of each antenna on each channel from `begin_s` on, in steps of 1 ms.
std::map<std::pair<std::string, std::size_t>, int> times_on_channels(
    const std::vector<AntennaParameters>& antennas, double begin_s, double duration_s) {
  const PortCycle cycle = port_cycles(antennas).front();
  const ChannelPlan& plan = physical(antennas[0])->plan;
  std::map<std::pair<std::string, std::size_t>, int> times;
  for (double t = begin_s + 5e-4; t < begin_s + duration_s; t += 1e-3) {
    ++times[{antenna_on_turn(cycle, at_second(t)), channel_at(plan, at_second(t), 1, 1)}];
  }
  return times;
}

TEST(PortCycles, BringEachPortToEachChannelForAsLong) {
  // Turns as long as a channel's dwell time and a sequence that is a multiple of the cycle: each
  // port would only use every second or fourth channel.
  for (const std::size_t ports : {2U, 4U}) {
    const auto antennas = hopping(std::vector<double>(ports, 0.2), 8, 0.2);
    const double all_s = 8 * 0.2 * static_cast<double>(ports);
    for (const double begin_s : {0.0, 12.8, -12.8}) {
      const auto times = times_on_channels(antennas, begin_s, all_s);
      EXPECT_EQ(times.size(), 8 * ports);
      for (const auto& [which, milliseconds] : times) EXPECT_EQ(milliseconds, 200) << which.first;
    }
  }
}

RC_GTEST_PROP(PortCycles, BringEachPortToEachChannel, ()) {
  const int channels = *rc::gen::inRange(2, 12);
  const double channel_dwell_s = 0.05 * *rc::gen::inRange(1, 8);
  std::vector<double> dwells_s(static_cast<std::size_t>(*rc::gen::inRange(2, 6)));
  for (double& dwell_s : dwells_s) dwell_s = 0.05 * *rc::gen::inRange(1, 8);
  const auto antennas = hopping(dwells_s, channels, channel_dwell_s);
  const double cycle_s = std::accumulate(dwells_s.begin(), dwells_s.end(), 0.0);
  const double sequence_s = channels * channel_dwell_s;
  const double restart_s = std::ceil(cycle_s / sequence_s - 1e-9) * sequence_s;
  const double shortest_s = *std::min_element(dwells_s.begin(), dwells_s.end());
  const double restarts = std::ceil(cycle_s / shortest_s - 1e-9);
  const auto times = times_on_channels(antennas, 0.0, restart_s * restarts);
  RC_ASSERT(times.size() == dwells_s.size() * static_cast<std::size_t>(channels));
}

RC_GTEST_PROP(NextTurn, BeginsWhereTheAntennaIsOnTurnAndWasNotBefore, ()) {
  const auto antennas =
      hopping({0.05 * *rc::gen::inRange(1, 8), 0.05 * *rc::gen::inRange(1, 8), 0.2},
              *rc::gen::inRange(2, 6), 0.05 * *rc::gen::inRange(1, 8));
  const PortCycle cycle = port_cycles(antennas).front();
  const Time now = at_second(1e-3 * *rc::gen::inRange(-5000, 5000));
  for (const AntennaParameters& one : antennas) {
    const Time turn = *next_turn(cycle, one.name, now);
    RC_ASSERT(antenna_on_turn(cycle, turn) == one.name);
    // Stepping from change to change skips no other antenna.
    for (Time t = now; t < turn; t = *next_change({cycle}, t)) {
      RC_ASSERT(antenna_on_turn(cycle, t) != one.name);
      RC_ASSERT(antenna_on_turn(cycle, *next_change({cycle}, t) - Duration(1)) ==
                antenna_on_turn(cycle, t));
    }
  }
}

TEST(PortCycles, KeepTurnsThatOutlastAllChannels) {
  const auto cycles = port_cycles(hopping({30.0, 30.0}, 50, 0.2));
  EXPECT_EQ(next_change(cycles, at_second(65.0)), at_second(90.0));
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
