// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "tagfield/base/error.h"
#include "tagfield/report/summary.h"
#include "tagfield/report/test/run_folder.h"

namespace tagfield {
namespace {

NavigationSummary full_navigation() {
  NavigationSummary navigation;
  navigation.walls_found = 0.99;
  navigation.goals = 3;
  navigation.goals_reached = 2;
  navigation.goals_unreached = {{7, {1.0, -2.0, 0.5}, "off the map"}};
  navigation.closest_m = 0.1;
  navigation.collisions = 4;
  navigation.times_lost = 1;
  navigation.unknown_starts =
      FindingSummary{20, 20, 19, 1, statistics({10.0, 30.0}), statistics({2.0, 6.0})};
  navigation.kidnapped = FindingSummary{2, 1, 0, 0, std::nullopt, std::nullopt};
  return navigation;
}

/// A summary with all members set.
Summary full_summary() {
  Summary summary = summary_of({});
  summary.seeds = {std::numeric_limits<std::uint64_t>::max()};
  summary.description = "a \"quoted\" line\nand another";
  summary.complete = false;
  summary.path_length_m = 22.1;
  summary.reads = 7012;
  summary.real_time_factor = 180.5;
  summary.warnings = {"first", "second"};
  summary.pose_error = PoseErrorSummary{0.01, 5.0, 0.02, 0.0141, statistics({0.001, 0.004})};
  summary.compared_pose = ComparedPose{"odometry", 0.25, statistics({0.2, 0.5}), 2};
  summary.method_asked = "auto";
  summary.method_why = "the pose is not exact";
  summary.pose_error->corrected_rms_m = 0.003;
  summary.compared_methods = {{"joint", 9, 1, 0, statistics({0.01, 0.02}), statistics({0.004})},
                              {"hyperbola", 8, 0, 2, std::nullopt, std::nullopt}};
  summary.navigation = full_navigation();
  summary.tags[0].truth_m.reset();
  summary.tags[0].moved = true;
  TagEstimate& estimate = summary.tags[1].estimate;
  estimate.verdict = Verdict::kAmbiguous;
  estimate.reason = "two mirror images";
  estimate.candidates.push_back({{1.0, 2.0, 3.0}, 0.1, 0.2});
  summary.tags[2].reference = true;
  summary.tags[2].estimate.verdict = Verdict::kNotLocated;
  summary.tags[2].estimate.candidates.clear();
  return summary;
}

void expect_error(const std::string& text, const std::string& message) {
  try {
    summary_from_json(text, "run/summary.json");
    ADD_FAILURE() << "no error where expected: " << message;
  } catch (const Error& error) {
    EXPECT_EQ(std::string(error.what()), "run/summary.json: " + message);
  }
}

/// The full summary with one value replaced.
std::string with(const std::string& pointer, const nlohmann::ordered_json& value) {
  auto json = nlohmann::ordered_json::parse(to_json(full_summary()));
  json[nlohmann::ordered_json::json_pointer(pointer)] = value;
  return json.dump();
}

TEST(SummaryJson, ComesBackTheSame) {
  const Summary before = full_summary();
  const Summary after = summary_from_json(to_json(before), "summary.json");
  EXPECT_EQ(to_json(after), to_json(before));
  EXPECT_EQ(after.seeds, before.seeds);
  EXPECT_EQ(after.tags[1].estimate.candidates[1].p_WT, Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_DOUBLE_EQ(after.tags[1].estimate.candidates[1].expected_error_m, 0.2);
  EXPECT_TRUE(after.tags[0].moved);
  EXPECT_TRUE(after.tags[2].reference);
  EXPECT_EQ(after.method_asked, "auto");
  EXPECT_EQ(after.method_why, "the pose is not exact");
  ASSERT_EQ(after.compared_methods.size(), 2u);
  EXPECT_DOUBLE_EQ(after.compared_methods[0].aligned_error_m->mean, 0.004);
  EXPECT_EQ(after.compared_methods[1].not_located, 2u);
  EXPECT_DOUBLE_EQ(after.pose_error->corrected_rms_m.value(), 0.003);
  EXPECT_FALSE(after.tags[0].truth_m);
}

TEST(SummaryJson, ComparesPosesWhereThereAreTwo) {
  const Summary after = summary_from_json(to_json(full_summary()), "f");
  ASSERT_TRUE(after.compared_pose);
  EXPECT_EQ(after.compared_pose->pose, "odometry");
  EXPECT_EQ(after.compared_pose->position_rms_m, 0.25);
  EXPECT_EQ(after.compared_pose->error_m->max, 0.5);
  EXPECT_EQ(after.compared_pose->located, 2U);
  EXPECT_TRUE(nlohmann::json::parse(to_json(summary_of({})))["compared_pose"].is_null());
}

TEST(SummaryJson, TellsHowRobotsFoundTheirWay) {
  const Summary after = summary_from_json(to_json(full_summary()), "f");
  ASSERT_TRUE(after.navigation);
  const NavigationSummary& navigation = *after.navigation;
  EXPECT_EQ(navigation.collisions, 4U);
  ASSERT_EQ(navigation.goals_unreached.size(), 1U);
  EXPECT_EQ(navigation.goals_unreached[0].seed, 7U);
  EXPECT_EQ(navigation.goals_unreached[0].goal, Eigen::Vector3d(1.0, -2.0, 0.5));
  EXPECT_EQ(navigation.goals_unreached[0].reason, "off the map");
  ASSERT_TRUE(navigation.unknown_starts);
  EXPECT_EQ(navigation.unknown_starts->found, 19U);
  EXPECT_EQ(navigation.unknown_starts->driven_m->max, 6.0);
  ASSERT_TRUE(navigation.kidnapped);
  EXPECT_EQ(navigation.kidnapped->noticed, 1U);
  EXPECT_FALSE(navigation.kidnapped->seconds);
  EXPECT_FALSE(navigation.lost);
}

RC_GTEST_PROP(SummaryJson, KeepsAnyNumber, (double number, std::uint64_t seed)) {
  const double length = std::fmod(number, 1e15);
  RC_PRE(std::isfinite(length));
  Summary summary;
  summary.path_length_m = length;
  summary.seeds = {seed};
  const Summary after = summary_from_json(to_json(summary), "f");
  RC_ASSERT(after.path_length_m == length);
  RC_ASSERT(after.seeds == summary.seeds);
}

TEST(SummaryJson, GivesNullForTheUnknown) {
  Summary summary = full_summary();
  summary.real_time_factor = std::numeric_limits<double>::infinity();
  const auto json = nlohmann::json::parse(to_json(summary));
  EXPECT_TRUE(json["real_time_factor"].is_null());
  EXPECT_TRUE(json["tags"][1]["estimate_m"].is_null());
  EXPECT_TRUE(json["tags"][1]["error_m"].is_null());
  EXPECT_TRUE(json["tags"][2]["rms_m"].is_null());
  EXPECT_DOUBLE_EQ(summary_from_json(to_json(summary), "f").real_time_factor, 0.0);
}

TEST(SummaryJson, SumsUp) {
  const auto json = nlohmann::json::parse(to_json(summary_of({})));
  EXPECT_NEAR(json["error_m"]["mean"].get<double>(), 0.01, 1e-12);
  EXPECT_EQ(json["error_m"]["count"], 3);
  EXPECT_EQ(json["over_0_3_m"], 0);
  EXPECT_EQ(json["located"], 3);
}

TEST(SummaryJson, TakesNamesThatAreNoText) {
  Summary summary = summary_of({});
  summary.tags[0].estimate.tag = "\xFF\xFE";
  EXPECT_NO_THROW(summary_from_json(to_json(summary), "f"));
}

TEST(SummaryFromJson, NamesFileAndPathOfWhatIsWrong) {
  expect_error("[]", "the file is array, expected an object");
  expect_error("{}", "scenario is missing");
  auto without = nlohmann::ordered_json::parse(to_json(full_summary()));
  without["navigation"].erase("collisions");
  expect_error(without.dump(), "navigation.collisions is missing");
  expect_error(with("/reads", -1), "reads is number, expected a whole number from 0 on");
  expect_error(with("/complete", "yes"), "complete is string, expected true or false");
  expect_error(with("/tags/1/id", 7), "tags[1].id is number, expected a text");
  expect_error(with("/tags/1/truth_m", {1, 2}), "tags[1].truth_m has 2 numbers, expected x, y, z");
  expect_error(with("/tags/1/candidates_m/0/2", "x"),
               "tags[1].candidates_m[0][2] is string, expected a number");
  expect_error(with("/tags/1/verdict", "lost"),
               "tags[1].verdict is 'lost', expected located, ambiguous or not_located");
  expect_error(with("/compared_pose/located", -1),
               "compared_pose.located is number, expected a whole number from 0 on");
  expect_error(with("/pose_error/sigma_m", 1e300), "pose_error.sigma_m is beyond ±1e15");
  expect_error(with("/tags/2/verdict", "located"), "tags[2] is located but has no candidates_m");
}

TEST(SummaryFromJson, TakesNothingThatIsNotJson) {
  expect_error("{\"scenario\": ", "is not JSON (byte 14)");
  expect_error("{\"scenario\": 1e999}", "is not JSON (a number is too great)");
}

TEST(SummaryFromJson, NeverCrashesOnDeepNesting) {
  EXPECT_THROW(summary_from_json(std::string(100000, '['), "f"), Error);
}

}  // namespace
}  // namespace tagfield
