// SPDX-License-Identifier: Apache-2.0
#include "tagfield/simulator/simulation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>

#include "tagfield/base/units.h"
#include "tagfield/reader/channel_plan.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/simulator/test/recorded.h"
#include "tagfield/stream/recording.h"

namespace tagfield {
namespace {

AntennaSpec antenna_at(const std::string& name, const Eigen::Vector3d& position) {
  AntennaSpec antenna;
  antenna.parameters.name = name;
  paper(antenna.parameters).range_sigma = 0.0;
  paper(antenna.parameters).model.phase_noise_rad = 0.0;
  paper(antenna.parameters).model.rssi_noise = 0.0;
  antenna.X_PA = from_translation(position);
  return antenna;
}

Scenario fixed_antenna_and_tag() {
  Scenario scenario;
  scenario.duration_s = 2.0;
  scenario.antennas = {antenna_at("antenna", {0.0, 0.0, 1.0})};
  scenario.tags = {tag_at("tag", {3.0, 0.0, 1.0})};
  return scenario;
}

std::set<std::string> tags_read_between(const Recording& recording, double from, double to) {
  std::set<std::string> tags;
  for (const TagRead& read : recording.reads) {
    const double t = to_seconds(read.stamp);
    if (t >= from && t < to) tags.insert(read.tag);
  }
  return tags;
}

double expected_phase(double distance) {
  return wrap_to_two_pi(4.0 * kPi * distance / wavelength(865.7e6));
}

TEST(Simulation, StampsReadsAtTheAntennasRateAndNotAtItsOwnSteps) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.time_step_s = 0.01;  // not a divisor of 1/15 s
  const Recording recording = recorded_run(scenario);
  ASSERT_EQ(recording.reads.size(), 30U);
  for (std::size_t k = 0; k < recording.reads.size(); ++k) {
    EXPECT_NEAR(to_seconds(recording.reads[k].stamp), static_cast<double>(k) / 15.0, 1e-9);
  }
}

/// What it reads does not depend on how often its antenna is updated, nor end with the last update.
TEST(Simulation, AnInventoryIsReadToTheEndOfTheRun) {
  const auto reads_at = [](double rate_hz) {
    Scenario scenario = fixed_antenna_and_tag();
    scenario.duration_s = 1.0;
    RadioModel model;
    model.gen2.emplace();
    model.gen2->inventory.target = Target::kAlternate;  // Reads the tag again and again.
    model.plan = fixed_plan(865.7e6);
    scenario.antennas[0].parameters.model = std::make_shared<const RadioModel>(model);
    scenario.antennas[0].parameters.rate_hz = rate_hz;
    return recorded_run(scenario).reads;
  };
  const std::vector<TagRead> seldom = reads_at(1.0);
  const std::vector<TagRead> often = reads_at(10.0);
  ASSERT_GT(seldom.size(), 20U);
  EXPECT_GT(to_seconds(seldom.back().stamp), 0.95);
  EXPECT_LT(to_seconds(seldom.back().stamp), 1.0);
  ASSERT_EQ(often.size(), seldom.size());
  for (std::size_t i = 0; i < seldom.size(); ++i) EXPECT_EQ(often[i].stamp, seldom[i].stamp);
}

TEST(Simulation, StepLengthDoesNotChangeWhatIsRead) {
  Scenario scenario = fixed_antenna_and_tag();
  paper(scenario.antennas[0].parameters).model.phase_noise_rad = 0.1;
  scenario.tags[0].motion.push_back({time_from_seconds(2.0), from_translation({4.0, 1.0, 1.0})});
  const Recording fine = recorded_run(scenario);
  scenario.time_step_s = 0.25;
  const Recording coarse = recorded_run(scenario);
  ASSERT_EQ(fine.reads.size(), coarse.reads.size());
  for (std::size_t i = 0; i < fine.reads.size(); ++i) {
    EXPECT_EQ(fine.reads[i].stamp, coarse.reads[i].stamp);
    EXPECT_EQ(fine.reads[i].phase_rad, coarse.reads[i].phase_rad);
  }
}

TEST(Simulation, PhaseFollowsATagAlongItsTrajectory) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.tags[0].motion = {{time_from_seconds(0.5), from_translation({2.0, 0.0, 1.0})},
                             {time_from_seconds(1.5), from_translation({4.0, 0.0, 1.0})}};
  for (const TagRead& read : recorded_run(scenario).reads) {
    const double x = 2.0 + 2.0 * std::clamp(to_seconds(read.stamp) - 0.5, 0.0, 1.0);
    EXPECT_NEAR(std::abs(wrap_to_pi(read.phase_rad - expected_phase(x))), 0.0, 1e-6);
  }
}

TEST(Simulation, ARobotCarriesAntennaAndTag) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.duration_s.reset();
  RobotSpec robot;
  robot.name = "robot";
  robot.start = {0.0, 0.0, kPi / 2.0};
  robot.waypoints = {{0.0, 2.0}};
  scenario.robots = {robot};
  scenario.antennas[0].on = "robot";
  scenario.antennas[0].X_PA = from_translation({0.5, 0.0, 1.5});
  scenario.tags.push_back(tag_at("load", {0.0, 0.0, 1.0}));
  scenario.tags.back().on = "robot";
  const Recording recording = recorded_run(scenario);
  // Facing +y, the antenna is half a metre ahead in y; it drives at 0.3 m/s.
  for (const AntennaPose& pose : recording.truth.antenna_poses) {
    const double driven = 0.3 * to_seconds(pose.stamp);
    if (driven > 1.99) continue;  // It stops within a step of its waypoint.
    EXPECT_NEAR(pose.X_WA.translation.x(), 0.0, 1e-9);
    EXPECT_NEAR(pose.X_WA.translation.y(), driven + 0.5, 1e-9);
    EXPECT_NEAR(pose.X_WA.translation.z(), 1.5, 1e-9);
  }
  // Load and antenna keep their distance of √(0.5² + 0.5²).
  for (const TrueDistance& distance : recording.truth.distances) {
    if (distance.tag == "load") {
      EXPECT_NEAR(distance.distance_m, std::sqrt(0.5), 1e-9);
    }
  }
}

TEST(Simulation, ALiftMovesTheAntenna) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.antennas[0].lift = {1.0, 0.5};
  const Recording recording = recorded_run(scenario);
  ASSERT_EQ(recording.truth.antenna_poses.size(), 30U);
  for (const AntennaPose& pose : recording.truth.antenna_poses) {
    EXPECT_NEAR(pose.X_WA.translation.z(), 1.0 + 0.5 * to_seconds(pose.stamp), 1e-9);
  }
}

TEST(Simulation, ReadsOnlyWithinTheRange) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.tags = {tag_at("near", {6.99, 0.0, 1.0}), tag_at("far", {7.01, 0.0, 1.0}),
                   tag_at("above", {0.0, 0.0, 8.5})};
  EXPECT_EQ(tags_read_between(recorded_run(scenario), 0.0, 2.0), (std::set<std::string>{"near"}));
}

TEST(Simulation, TagsAppearAndDisappearByTheScenario) {
  Scenario scenario = fixed_antenna_and_tag();
  scenario.tags[0].appears = time_from_seconds(0.5);
  scenario.tags[0].disappears = time_from_seconds(1.2);
  const Recording recording = recorded_run(scenario);
  EXPECT_TRUE(tags_read_between(recording, 0.0, 0.5).empty());
  EXPECT_TRUE(tags_read_between(recording, 1.2, 2.0).empty());
  // Updates at 8/15 … 17/15 s, and none else.
  EXPECT_EQ(recording.reads.size(), 10U);
}

TEST(Simulation, TagsCanBeAddedAndRemovedAtAnyTime) {
  Scenario scenario = fixed_antenna_and_tag();
  Recording recording;
  Simulation simulation(scenario, 1, recorded_in(recording));
  while (simulation.now() < time_from_seconds(0.5)) simulation.step();
  simulation.add_tag(tag_at("new", {1.0, 0.0, 1.0}));
  simulation.remove_tag("tag");
  EXPECT_THROW(simulation.add_tag(tag_at("new", {0.0, 1.0, 1.0})), Error);
  EXPECT_THROW(simulation.remove_tag("tag"), Error);
  while (!simulation.finished()) simulation.step();
  EXPECT_EQ(tags_read_between(recording, 0.0, 0.5), (std::set<std::string>{"tag"}));
  EXPECT_EQ(tags_read_between(recording, 0.5, 2.0), (std::set<std::string>{"new"}));
}

TEST(Simulation, AntennasCanBeAddedAndRemovedAtAnyTime) {
  Recording recording;
  Simulation simulation(fixed_antenna_and_tag(), 1, recorded_in(recording));
  simulation.step();
  simulation.remove_antenna("antenna");
  simulation.add_antenna(antenna_at("other", {2.0, 0.0, 1.0}));
  EXPECT_THROW(simulation.add_antenna(antenna_at("other", {0.0, 0.0, 0.0})), Error);
  EXPECT_THROW(simulation.remove_antenna("antenna"), Error);
  while (!simulation.finished()) simulation.step();
  EXPECT_EQ(recording.reads.front().antenna, "antenna");
  EXPECT_EQ(std::count_if(recording.reads.begin(), recording.reads.end(),
                          [](const TagRead& read) { return read.antenna == "other"; }),
            29);
}

TEST(Simulation, OtherTagsAndAntennasDoNotChangeARead) {
  Scenario scenario = fixed_antenna_and_tag();
  paper(scenario.antennas[0].parameters).model.phase_noise_rad = 0.1;
  const Recording alone = recorded_run(scenario);
  scenario.tags.insert(scenario.tags.begin(), tag_at("other", {1.0, 1.0, 1.0}));
  scenario.antennas.insert(scenario.antennas.begin(), antenna_at("second", {1.0, 0.0, 0.0}));
  std::vector<double> phases;
  for (const TagRead& read : recorded_run(scenario).reads) {
    if (read.tag == "tag" && read.antenna == "antenna") phases.push_back(read.phase_rad);
  }
  ASSERT_EQ(phases.size(), alone.reads.size());
  for (std::size_t i = 0; i < phases.size(); ++i) EXPECT_EQ(phases[i], alone.reads[i].phase_rad);
}

TEST(Simulation, SeedsDiffer) {
  Scenario scenario = fixed_antenna_and_tag();
  paper(scenario.antennas[0].parameters).model.phase_noise_rad = 0.1;
  EXPECT_EQ(recorded_run(scenario, 5).reads[3].phase_rad,
            recorded_run(scenario, 5).reads[3].phase_rad);
  EXPECT_NE(recorded_run(scenario, 5).reads[3].phase_rad,
            recorded_run(scenario, 6).reads[3].phase_rad);
}

TEST(Simulation, RefusesWhatCannotBeSimulated) {
  Scenario twice = fixed_antenna_and_tag();
  twice.tags.push_back(twice.tags[0]);
  EXPECT_THROW(Simulation(twice, 1), Error);
  Scenario nobody = fixed_antenna_and_tag();
  nobody.antennas[0].on = "nobody";
  EXPECT_THROW(Simulation(nobody, 1), Error);
  Scenario endless = fixed_antenna_and_tag();
  endless.duration_s.reset();
  EXPECT_THROW(Simulation(endless, 1), Error);
  Scenario silent = fixed_antenna_and_tag();
  silent.antennas[0].parameters.rate_hz = 0.0;
  EXPECT_THROW(Simulation(silent, 1), Error);
}

}  // namespace
}  // namespace tagfield
