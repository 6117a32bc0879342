// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/live_world.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <thread>

#include "tagfield/base/error.h"
#include "tagfield/base/units.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/simulator/test/recorded.h"

namespace tagfield {
namespace {

/// Runs a task at each given time, then ends the run.
class Script final : public LiveMember {
 public:
  void at(double seconds, LiveWorld::Task task) {
    todo_.emplace(time_from_seconds(seconds), std::move(task));
  }
  void play(LiveWorld& world, const std::shared_ptr<Script>& self, double until_s) {
    at(until_s, [this](LiveWorld&) { stop_ = true; });
    world.attach(self);
    world.run(stop_);
  }
  void on_step(LiveWorld& world, Time now) override {
    while (!todo_.empty() && todo_.begin()->first <= now) {
      const LiveWorld::Task task = todo_.begin()->second;
      todo_.erase(todo_.begin());
      task(world);
    }
  }

 private:
  std::multimap<Time, LiveWorld::Task> todo_;
  std::atomic<bool> stop_{false};
};

LiveOptions fast() {
  LiveOptions options;
  options.speed = 0.0;
  return options;
}

/// Four antennas on one reader, with Gen2, in a room; without noise and RSSI quantization.
Scenario portal() {
  Diagnostics diagnostics;
  return load_scenario_with_world(
             TAGFIELD_SOURCE_DIR "/scenarios/portal.yaml",
             {{"without", "[noise, quantization, hopping]"}, {"duration_s", "4"}}, diagnostics)
      .scenario;
}

/// Mean RSSI of a tag's reads by an antenna between two times.
double mean_rssi(const Recording& recording, const std::string& antenna, const std::string& tag,
                 double from, double to) {
  double sum = 0.0;
  int count = 0;
  for (const TagRead& read : recording.reads) {
    const double t = to_seconds(read.stamp);
    if (read.antenna != antenna || read.tag != tag || t < from || t >= to) continue;
    sum += read.rssi_dbm;
    ++count;
  }
  EXPECT_GT(count, 2) << antenna << " " << tag;
  return sum / count;
}

int reads_between(const Recording& recording, double from, double to,
                  const std::string& antenna = "", const std::string& tag = "") {
  return static_cast<int>(
      std::count_if(recording.reads.begin(), recording.reads.end(), [&](const TagRead& read) {
        const double t = to_seconds(read.stamp);
        return t >= from && t < to && (antenna.empty() || read.antenna == antenna) &&
               (tag.empty() || read.tag == tag);
      }));
}

TEST(LiveWorld, ReadsWhatTheHeadlessRunReads) {
  const Scenario scenario = portal();
  const Recording headless = recorded_run(scenario);
  Recording recording;
  LiveWorld world(scenario, scenario.seed, recorded_in(recording), fast());
  const auto script = std::make_shared<Script>();
  script->play(world, script, 4.5);
  ASSERT_GT(headless.reads.size(), 100U);
  ASSERT_GE(recording.reads.size(), headless.reads.size());
  for (std::size_t i = 0; i < headless.reads.size(); ++i) {
    const TagRead& read = recording.reads[i];
    const TagRead& expected = headless.reads[i];
    ASSERT_EQ(read.stamp, expected.stamp) << i;
    ASSERT_EQ(read.tag, expected.tag) << i;
    ASSERT_EQ(read.antenna, expected.antenna) << i;
    ASSERT_EQ(read.phase_rad, expected.phase_rad) << i;
    ASSERT_EQ(read.rssi_dbm, expected.rssi_dbm) << i;
  }
}

TEST(LiveWorld, ADutyChangesWhoSendsAndHowStrongly) {
  const Scenario scenario = portal();
  Recording recording;
  LiveOptions options = fast();
  options.readers_start = false;
  LiveWorld world(scenario, 1, recorded_in(recording), options);
  const auto script = std::make_shared<Script>();
  ReaderDuty duty;
  duty.antennas = {{"port_1", 30.0}};
  script->at(1.0, [duty](LiveWorld& live) {
    EXPECT_FALSE(live.antennas()[0].is_on);
    EXPECT_TRUE(live.set_duty("portal", duty).empty());
    EXPECT_TRUE(live.antennas()[0].is_on);
    EXPECT_FALSE(live.antennas()[1].is_on);
  });
  script->at(2.0, [duty](LiveWorld& live) {
    ReaderDuty weaker = duty;
    weaker.antennas[0].transmit_power_dbm = 27.0;
    live.set_duty("portal", weaker);
  });
  script->at(3.0, [](LiveWorld& live) { live.set_duty("portal", {}); });
  script->play(world, script, 4.0);
  EXPECT_EQ(reads_between(recording, 0.0, 1.0), 0);
  EXPECT_GT(reads_between(recording, 1.0, 2.0, "port_1"), 50);
  EXPECT_EQ(reads_between(recording, 1.0, 3.0), reads_between(recording, 1.0, 3.0, "port_1"));
  EXPECT_EQ(reads_between(recording, 3.0, 4.0), 0);
  // Backscatter: 3 dB less transmit power weakens the reply by 3 dB.
  EXPECT_NEAR(mean_rssi(recording, "port_1", "tag_01", 1.0, 2.0) -
                  mean_rssi(recording, "port_1", "tag_01", 2.0, 3.0),
              3.0, 1e-9);
  // Inventories continue until that very moment: the last reads come from a slot just before it.
  EXPECT_GT(to_seconds(recording.reads.back().stamp), 2.98);
  EXPECT_LT(to_seconds(recording.reads.front().stamp), 1.02);
}

TEST(LiveWorld, ADetunedTagLosesItTwice) {
  const Scenario scenario = portal();
  Recording recording;
  LiveWorld world(scenario, 1, recorded_in(recording), fast());
  const auto script = std::make_shared<Script>();
  script->at(2.0, [](LiveWorld& live) { live.detune_tag("tag_01", 1.5); });
  script->play(world, script, 4.0);
  EXPECT_NEAR(mean_rssi(recording, "port_1", "tag_01", 0.0, 2.0) -
                  mean_rssi(recording, "port_1", "tag_01", 2.0, 4.0),
              3.0, 1e-9);
  EXPECT_NEAR(mean_rssi(recording, "port_1", "tag_02", 0.0, 2.0),
              mean_rssi(recording, "port_1", "tag_02", 2.0, 4.0), 1e-9);
}

/// The paper's antenna at the origin without noise, tags along x.
Scenario plain() {
  Scenario scenario;
  scenario.duration_s = 1.0;
  AntennaSpec antenna;
  antenna.parameters.name = "antenna";
  paper(antenna.parameters).range_sigma = 0.0;
  paper(antenna.parameters).model.phase_noise_rad = 0.0;
  paper(antenna.parameters).model.rssi_noise = 0.0;
  scenario.antennas = {antenna};
  scenario.tags = {tag_at("tag", {3.0, 0.0, 0.0}), tag_at("other", {4.0, 0.0, 0.0})};
  return scenario;
}

double phase_at(double distance_m) {
  return wrap_to_two_pi(4.0 * kPi * distance_m / wavelength(865.7e6));
}

void expect_phase(const Recording& recording, double from, double to, double distance_m) {
  int count = 0;
  for (const TagRead& read : recording.reads) {
    const double t = to_seconds(read.stamp);
    if (read.tag != "tag" || t < from || t >= to) continue;
    EXPECT_NEAR(std::remainder(read.phase_rad - phase_at(distance_m), 2.0 * kPi), 0.0, 1e-6) << t;
    ++count;
  }
  EXPECT_EQ(count, 15);
}

TEST(LiveWorld, TagsAndAntennasMove) {
  Recording recording;
  LiveWorld world(plain(), 1, recorded_in(recording), fast());
  const auto script = std::make_shared<Script>();
  script->at(1.0, [](LiveWorld& live) { live.move_tag("tag", from_translation({2.5, 0.0, 0.0})); });
  script->at(2.0, [](LiveWorld& live) {
    live.move_antenna("antenna", from_translation({1.0, 0.0, 0.0}));
    EXPECT_EQ(live.antenna_pose(live.antennas()[0]).translation.x(), 1.0);
  });
  script->play(world, script, 3.0);
  expect_phase(recording, 0.0, 1.0, 3.0);
  expect_phase(recording, 1.0, 2.0, 2.5);
  expect_phase(recording, 2.0, 3.0, 1.5);
}

TEST(LiveWorld, TagsComeAndGoAndCablesAreUnplugged) {
  Recording recording;
  LiveWorld world(plain(), 1, recorded_in(recording), fast());
  const auto script = std::make_shared<Script>();
  script->at(1.0, [](LiveWorld& live) {
    live.add_tag(tag_at("new", {1.0, 1.0, 0.0}));
    live.remove_tag("other");
    EXPECT_EQ(live.tags().size(), 2U);
  });
  script->at(2.0, [](LiveWorld& live) { live.set_antenna_faulty("antenna", true); });
  script->at(3.0, [](LiveWorld& live) {
    EXPECT_THROW(static_cast<void>(live.explain("antenna", "tag")), Error);
    live.set_antenna_faulty("antenna", false);
    EXPECT_TRUE(live.explain("antenna", "tag").read);
  });
  script->play(world, script, 4.0);
  EXPECT_EQ(reads_between(recording, 0.0, 1.0, "", "other"), 15);
  EXPECT_EQ(reads_between(recording, 1.0, 2.0, "", "other"), 0);
  EXPECT_EQ(reads_between(recording, 1.0, 2.0, "", "new"), 15);
  EXPECT_EQ(reads_between(recording, 2.0, 3.0), 0);
  EXPECT_EQ(reads_between(recording, 3.0, 4.0), 30);
}

TEST(LiveWorld, PortsStayTheirAntennas) {
  LiveWorld world(plain(), 1, {}, fast());
  AntennaSpec other = plain().antennas[0];
  for (const char* name : {"second", "third"}) {
    other.parameters.name = name;
    world.add_antenna(other);
  }
  const auto ports = [&] {
    std::map<std::string, int> all;
    for (const LiveAntenna& antenna : world.antennas()) {
      all[antenna.spec.parameters.name] = antenna.port;
    }
    return all;
  };
  using Ports = std::map<std::string, int>;
  EXPECT_EQ(ports(), (Ports{{"antenna", 1}, {"second", 2}, {"third", 3}}));
  world.remove_antenna("second");
  other.parameters.name = "fourth";
  world.add_antenna(other);
  EXPECT_EQ(ports(), (Ports{{"antenna", 1}, {"third", 3}, {"fourth", 4}}));
  other.parameters.name = "second";
  world.add_antenna(other);
  EXPECT_EQ(ports(), (Ports{{"antenna", 1}, {"second", 2}, {"third", 3}, {"fourth", 4}}));
}

TEST(LiveWorld, WhatCannotBeDoneChangesNothing) {
  LiveWorld world(plain(), 1, {}, fast());
  EXPECT_THROW(world.remove_tag("nobody"), Error);
  EXPECT_THROW(world.add_tag(tag_at("tag", {0.0, 0.0, 0.0})), Error);
  EXPECT_THROW(world.add_tag(tag_at("urn:epc:id:sgtin:061.1", {0.0, 0.0, 0.0})), Error);
  EXPECT_THROW(world.move_tag("tag", from_translation({NAN, 0.0, 0.0})), Error);
  EXPECT_THROW(world.move_tag("tag", from_translation({1e6, 0.0, 0.0})), Error);
  EXPECT_THROW(world.detune_tag("tag", -1.0), Error);
  EXPECT_THROW(world.add_antenna(plain().antennas[0]), Error);
  EXPECT_THROW(world.set_antenna_faulty("nobody", true), Error);
  EXPECT_THROW(world.set_speed(-1.0), Error);
  EXPECT_THROW(world.set_duty("nobody", {}), Error);
  ReaderDuty of_another;
  of_another.antennas = {{"nobody", std::nullopt}};
  EXPECT_THROW(world.set_duty("reader", of_another), Error);
  ASSERT_EQ(world.antennas().size(), 1U);
  EXPECT_TRUE(world.antennas()[0].is_on);
  EXPECT_EQ(world.tags().size(), 2U);
  EXPECT_EQ(world.tags()[0].X_W.translation.x(), 3.0);
}

TEST(LiveWorld, ABodyInTheWayTakesAwayPower) {
  const Scenario scenario = portal();
  Recording recording;
  LiveWorld world(scenario, 1, recorded_in(recording), fast());
  const auto script = std::make_shared<Script>();
  ObstacleSpec pallet;
  pallet.name = "pallet";
  pallet.size_m = {0.1, 1.5};
  pallet.yaw_rad = kPi / 4.0;
  pallet.motion = {{Time{}, from_translation({0.33, 0.37, 0.0})}};
  pallet.body = BodySpec{2.0, {}};
  pallet.body->material.is_opaque = true;
  double margin_free_db = 0.0;
  script->at(2.0, [pallet, &margin_free_db](LiveWorld& live) {
    margin_free_db = live.explain("port_1", "tag_01").physical->tag_margin_db();
    live.add_obstacle(pallet);
    EXPECT_THROW(live.add_obstacle(pallet), Error);
  });
  script->at(4.0, [&margin_free_db](LiveWorld& live) {
    EXPECT_LT(live.explain("port_1", "tag_01").physical->tag_margin_db(), margin_free_db - 10.0);
    live.remove_obstacle("pallet");
    EXPECT_EQ(live.explain("port_1", "tag_01").physical->tag_margin_db(), margin_free_db);
  });
  script->play(world, script, 7.0);
  const double free = mean_rssi(recording, "port_1", "tag_01", 0.0, 2.0);
  EXPECT_LT(mean_rssi(recording, "port_1", "tag_01", 2.1, 4.0), free - 20.0);
  EXPECT_NEAR(mean_rssi(recording, "port_1", "tag_01", 4.1, 7.0), free, 1e-9);
}

TEST(LiveWorld, TasksOfOtherThreadsAreDoneInOrderAndWhilePaused) {
  LiveOptions options = fast();
  options.is_paused = true;
  LiveWorld world(plain(), 1, {}, options);
  std::atomic<bool> stop{false};
  std::thread simulating([&] { world.run(stop); });
  std::vector<int> done;
  for (int i = 0; i < 100; ++i) world.post([&done, i](LiveWorld&) { done.push_back(i); });
  world.post([](LiveWorld& live) {
    EXPECT_EQ(live.now(), Time{});
    EXPECT_TRUE(live.is_paused());
    live.advance(duration_from_seconds(0.5));
  });
  std::atomic<bool> is_there{false};
  while (!is_there) {
    world.post([&is_there](LiveWorld& live) { is_there = live.is_paused(); });
    std::this_thread::yield();
  }
  world.post([&stop](LiveWorld& live) {
    EXPECT_NEAR(to_seconds(live.now()), 0.5, 1e-9);
    stop = true;
  });
  simulating.join();
  ASSERT_EQ(done.size(), 100U);
  for (int i = 0; i < 100; ++i) EXPECT_EQ(done[static_cast<std::size_t>(i)], i);
}

}  // namespace
}  // namespace tagfield
