// SPDX-License-Identifier: Apache-2.0
// Keys without effect in combination with others cause a warning at their location.
#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/scenario/scenario_yaml.h"

namespace tagfield {
namespace {

/// An antenna on a robot and a tag, with a physical model or the paper's model.
std::string hall(const std::string& model, const std::string& antenna = "",
                 const std::string& rest = "") {
  return "model: " + model + "\nduration_s: 3\nrobots:\n  - {name: r, start: [0, 0, 0]}\n" +
         "antennas:\n  - {name: a, on: r, pose: [0, 0, 1.5]" + antenna + "}\n" +
         "tags:\n  - {id: t, position: [2, 1, 1]}\n" + rest;
}

/// The warnings, without the file's name.
std::vector<std::string> warnings_of(const std::string& text) {
  const std::string path = folder_of_test().with("scenario.yaml", text);
  Diagnostics diagnostics;
  load_scenario(path, {}, diagnostics);
  std::vector<std::string> warnings = diagnostics.warnings();
  for (std::string& warning : warnings) {
    if (warning.rfind(path, 0) == 0) warning = warning.substr(path.size() + 1);
  }
  return warnings;
}

using Warnings = std::vector<std::string>;

TEST(IdleKeys, NoneAreThereInAPlainScenario) {
  for (const char* const model : {"paper", "link_budget", "multipath"}) {
    EXPECT_EQ(warnings_of(hall(model)), Warnings{}) << model;
  }
}

TEST(IdleKeys, ErrorsOfThePoseNeedTheirSource) {
  EXPECT_EQ(warnings_of(hall("paper", "", "pose: {sigma_m: 0.05, wheel_noise: 0.1}\n")),
            (Warnings{"9: pose.sigma_m has no effect with source: true; expected source: noisy",
                      "9: pose.wheel_noise has no effect with source: true; expected source: "
                      "odometry"}));
  EXPECT_EQ(warnings_of(hall("paper", "", "pose: {source: odometry, time_constant_s: 3}\n")),
            (Warnings{"9: pose.time_constant_s has no effect with source: odometry; expected "
                      "source: noisy"}));
  EXPECT_EQ(warnings_of(hall("paper", "", "pose: {source: noisy, sigma_m: 0.05}\n")), Warnings{});
  EXPECT_EQ(warnings_of(hall("paper", "", "pose: {source: odometry, sigma_m: 0}\n")), Warnings{});
}

TEST(IdleKeys, FlagsOfBNeedAnAntennaThatSetsThem) {
  const auto portal = [](const std::string& first, const std::string& second) {
    const std::string plain = ", reader: r, pose: [0, 0, 1], inventory: gen2";
    return warnings_of("model: link_budget\nduration_s: 3\nantennas:\n  - {name: a" + plain +
                       first + "}\n  - {name: b" + plain + second +
                       "}\ntags:\n  - {id: t, position: [2, 1, 1]}\n");
  };
  const std::string why =
      "reads nothing: with target: b it asks for flags of B, tags begin with A, and no antenna in "
      "its session, s3, has target: a or alternate";
  EXPECT_EQ(portal(", session: s3, target: b", ", session: s3, target: b"),
            (Warnings{"4: antenna 'a' " + why, "5: antenna 'b' " + why}));
  // In another session the other antenna's flags are others.
  EXPECT_EQ(portal(", session: s3, target: b", ", session: s2, target: a"),
            Warnings{"4: antenna 'a' " + why});
  for (const char* const target : {"a", "alternate"}) {
    EXPECT_EQ(portal(", session: s3, target: b", std::string(", session: s3, target: ") + target),
              Warnings{});
  }
}

TEST(IdleKeys, ASourceReplacedFromTheCommandLineIsTriedOut) {
  const std::string path = folder_of_test().with(
      "scenario.yaml", hall("paper", "", "pose: {source: noisy, sigma_m: 0.05}\n"));
  Diagnostics diagnostics;
  load_scenario(path, {{"pose.source", "true"}}, diagnostics);
  EXPECT_EQ(diagnostics.warnings(), Warnings{});
  load_scenario(path, {{"pose.source", "true"}, {"pose.sigma_m", "0.1"}}, diagnostics);
  EXPECT_EQ(diagnostics.warnings(),
            Warnings{"--set: pose.sigma_m has no effect with source: true; expected source: "
                     "noisy"});
}

TEST(IdleKeys, AKeyOfTheCommandLineIsLookedAtBesideTheFilesSource) {
  const std::string path =
      folder_of_test().with("scenario.yaml", hall("paper", "", "pose: {source: true}\n"));
  Diagnostics diagnostics;
  load_scenario(path, {{"pose.sigma_m", "0.1"}}, diagnostics);
  EXPECT_EQ(diagnostics.warnings(),
            Warnings{"--set: pose.sigma_m has no effect with source: true; expected source: "
                     "noisy"});
}

TEST(IdleKeys, ARobotThatNavigatesSteersByItsPlanner) {
  const std::string text = hall("paper", "", "navigation: slam\n");
  const std::string drives = "start: [0, 0, 0], waypoints: [[3, 0]], look_ahead_m: 0.4";
  EXPECT_EQ(warnings_of(std::string(text).replace(text.find("start: [0, 0, 0]"), 16, drives)),
            Warnings{"4: robots[0].look_ahead_m has no effect with navigation: slam, whose paths "
                     "navigation.driving describes"});
}

TEST(IdleKeys, ABeliefNeedsAnAntennaOnARobot) {
  constexpr const char* kFixed =
      "duration_s: 3\nantennas:\n  - {name: a, pose: [0, 0, 1.5]}\n"
      "tags:\n  - {id: t, position: [2, 1, 1]}\n";
  const Warnings expected = {
      " has no effect on reads: no antenna is on a robot, and poses of fixed and recorded ones are "
      "known exactly"};
  EXPECT_EQ(warnings_of(std::string(kFixed) + "pose: {source: noisy, sigma_m: 0.1}\n"),
            Warnings{"6: pose" + expected[0]});
  EXPECT_EQ(warnings_of(std::string(kFixed) + "navigation: noisy\n"),
            Warnings{"6: navigation" + expected[0]});
}

TEST(IdleKeys, ATimeOfCorrelationNeedsAnError) {
  EXPECT_EQ(
      warnings_of(hall("paper", "", "localization: {pose_error: {time_constant_s: 2}}\n")),
      Warnings{"9: localization.pose_error.time_constant_s has no effect without a sigma_m or a "
               "yaw_sigma_deg"});
  EXPECT_EQ(warnings_of(hall("paper", "",
                             "localization: {pose_error: {time_constant_s: 2, sigma_m: 0.1}}\n")),
            Warnings{});
}

TEST(IdleKeys, WhatNoMethodUsesIsWarnedOf) {
  const std::string keys = "max_rms_m: 0.1, offset: known, pi_ambiguity: true}\n";
  EXPECT_EQ(warnings_of(hall("paper", "", "localization: {method: trilateration, " + keys)),
            (Warnings{"9: localization.offset has no effect with trilateration",
                      "9: localization.pi_ambiguity has no effect with trilateration",
                      "9: localization.max_rms_m has no effect with trilateration"}));
  EXPECT_EQ(
      warnings_of(
          hall("paper", "", "localization: {method: trilateration, compare: [hyperbola], " + keys)),
      Warnings{"9: localization.offset has no effect with trilateration and hyperbola"});
  EXPECT_EQ(warnings_of(hall("paper", "", "localization: {method: sar, " + keys)), Warnings{});
}

TEST(IdleKeys, MaterialsAndOrientationsNeedAPhysicalModel) {
  const std::string rest =
      "  - {id: u, position: [2, 2, 1], rpy: [0, 0, 1]}\n"
      "obstacles:\n  - {radius_m: 0.3, position: [3, 0], material: person}\n";
  const std::string why =
      " has no effect with model: paper; expected model: link_budget or multipath";
  EXPECT_EQ(warnings_of(hall("paper", "", rest)),
            (Warnings{"11: obstacles[0].material" + why, "9: tags[1].rpy" + why}));
  EXPECT_EQ(warnings_of(hall("link_budget", "", rest)), Warnings{});
}

TEST(IdleKeys, ARoundObstacleHasNoHeading) {
  const std::string obstacle = "obstacles:\n  - {position: [3, 0], yaw: 0.5, ";
  EXPECT_EQ(warnings_of(hall("paper", "", obstacle + "radius_m: 0.3}\n")),
            Warnings{"10: obstacles[0].yaw has no effect on a round obstacle"});
  EXPECT_EQ(warnings_of(hall("paper", "", obstacle + "size: [1, 0.5]}\n")), Warnings{});
}

TEST(IdleKeys, AnObstacleWithoutMaterialIsForRobots) {
  const std::string antenna_alone =
      "model: link_budget\nduration_s: 3\nantennas:\n  - {name: a, pose: [0, 0, 1.5]}\n"
      "tags:\n  - {id: t, position: [2, 1, 1]}\n"
      "obstacles:\n  - {position: [3, 0], radius_m: 0.3";
  EXPECT_EQ(warnings_of(antenna_alone + "}\n"),
            Warnings{"8: obstacles[0] has no effect on reads: it has no material, and there is no "
                     "robot that could notice it"});
  EXPECT_EQ(warnings_of(antenna_alone + ", material: person}\n"), Warnings{});
}

TEST(IdleKeys, SettingsOfAntennasAndTagsAreReportedWithTheirNames) {
  EXPECT_EQ(
      warnings_of(hall("link_budget", ", session: s1",
                       "  - {id: u, position: [2, 2, 1], beam_width_deg: 40}\n")),
      (Warnings{
          "6: session of antenna 'a' has no effect without inventory: gen2",
          "9: beam_width_deg of tag 'u' has no effect with pattern: dipole; expected patch"}));
  // A profile describes all of its device.
  EXPECT_EQ(warnings_of(hall("link_budget", ", profiles: [speedway_r420]")), Warnings{});
}

TEST(IdleKeys, WhatIsSaidForAllAntennasNeedsOneThatUsesIt) {
  const std::string bends = "diffraction: on\n";
  EXPECT_EQ(warnings_of(hall("link_budget", "", bends)),
            Warnings{"9: diffraction of antenna 'a' has no effect with model: link_budget; "
                     "expected multipath"});
  EXPECT_EQ(
      warnings_of(hall("multipath", "}\n  - {name: b, model: link_budget, pose: [0, 0, 1]", bends)),
      Warnings{});
}

TEST(IdleKeys, TurnsNeedSomebodyToTakeThemWith) {
  const std::string antenna = ", inventory: gen2, port_dwell_s: 0.1, sharing: time";
  EXPECT_EQ(warnings_of(hall("link_budget", antenna)),
            (Warnings{"6: port_dwell_s of antenna 'a' has no effect: its reader has no other "
                      "antenna to take turns with",
                      "6: sharing: time of antenna 'a' has no effect: no other reader has it"}));
  EXPECT_EQ(warnings_of(hall("link_budget", antenna + "}\n  - {name: b, reader: two, pose: "
                                                      "[0, 0, 1], inventory: gen2, sharing: time")),
            Warnings{});
}

TEST(IdleKeys, AReaderSharesTheAirInOneWay) {
  const std::string second = "}\n  - {name: b, pose: [0, 0, 1], inventory: gen2, sharing: channel";
  EXPECT_TRUE(contains(error_of([&] {
                         warnings_of(
                             hall("link_budget", ", inventory: gen2, sharing: time" + second));
                       }),
                       "antenna 'a' has sharing: time, but antenna 'b' of the same reader, "));
}

TEST(IdleKeys, AReaderHopsByOneSequenceOfChannels) {
  const auto error_with = [](const std::string& second) {
    return error_of([&] {
      warnings_of(hall("link_budget",
                       ", channel_plan: fcc, inventory: gen2}\n  - {name: b, pose: "
                       "[0, 0, 1], inventory: gen2" +
                           second));
    });
  };
  EXPECT_TRUE(contains(error_with(", channel_plan: etsi_low"),
                       "6: antenna 'a' has 50 carriers from 902.75 to 927.25 MHz, 0.4 s each, but "
                       "antenna 'b' of the same reader, "));
  EXPECT_TRUE(contains(error_with(", channel_plan: etsi_low"),
                       "has 4 carriers from 865.7 to 867.5 MHz, 4 s each: expected the same "
                       "channels and dwell_s for all antennas of a reader"));
  EXPECT_TRUE(contains(error_with(", frequency_hz: 915.25e6"), ", has 915.25 MHz: expected"));
  EXPECT_TRUE(contains(error_with(""), ", has 865.7 MHz: expected"));
  EXPECT_TRUE(contains(error_with(", channel_plan: fcc, dwell_s: 0.2"), "0.2 s each: expected"));
  EXPECT_EQ(error_with(", channel_plan: fcc"), "(no error)");
  EXPECT_EQ(error_with(", channel_plan: etsi_low, reader: two"), "(no error)");
}

TEST(IdleKeys, PortsThatDoNotHopMayHaveTheirOwnCarriers) {
  EXPECT_EQ(warnings_of(hall("link_budget",
                             ", frequency_hz: 865.7e6}\n  - {name: b, pose: "
                             "[0, 0, 1], frequency_hz: 867.5e6")),
            Warnings{});
}

TEST(IdleKeys, LongThinObstaclesAreWalls) {
  const auto warnings_with = [](const std::string& model, const std::string& obstacle) {
    return warnings_of(hall(
        model, "",
        "obstacles:\n  - {name: wall, position: [1, 3], material: concrete, " + obstacle + "}\n"));
  };
  for (const char* const size : {"size: [8, 0.1]", "size: [0.1, 8]"}) {
    EXPECT_EQ(
        warnings_with("link_budget", size),
        Warnings{"10: obstacle 'wall' of 8 m by 0.1 m also shades part of what is in front of "
                 "it, as obstacles are modelled as screens at their centres, for compact "
                 "ones: walls belong in the world"});
  }
  for (const char* const size :
       {"size: [2, 0.1]", "size: [8, 2]", "radius_m: 3", "size: [1.2, 0.8]"}) {
    EXPECT_EQ(warnings_with("multipath", size), Warnings{}) << size;
  }
  // A robot's laser sees it as it is.
  EXPECT_EQ(warnings_of(hall("link_budget", "",
                             "obstacles:\n  - {name: wall, position: [1, 3], size: [8, 0.1]}\n")),
            Warnings{});
  EXPECT_EQ(warnings_of(hall("link_budget", ", without: [bodies]",
                             "obstacles:\n  - {name: wall, position: [1, 3], size: [8, 0.1], "
                             "material: metal}\n")),
            Warnings{});
}

TEST(IdleKeys, ParametersNeedTheirDistribution) {
  EXPECT_TRUE(contains(
      error_of([] { warnings_of(hall("paper", ", optional_distribution_params: [1, 2]")); }),
      "antennas[0].optional_distribution_params needs 'optional_distribution' beside it"));
}

}  // namespace
}  // namespace tagfield
