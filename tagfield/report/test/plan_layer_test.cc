// SPDX-License-Identifier: Apache-2.0
#include "tagfield/report/plan_layer.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tagfield/base/error.h"
#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/report/plan.h"

namespace tagfield {
namespace {

AntennaPlan shop() {
  AntennaPlan plan;
  plan.scenario = "shop";
  plan.dwell_s = 5.0;
  plan.tags = 10;
  plan.aim = {PlannedAim::Kind::kReads, 3.0, {}};
  plan.places = {{"shelf", "", {0, 0, 1}}, {"shelf", "", {2, 1, 2}}};
  for (const double p : {0.504, 1.0}) {
    PlannedLayout layout;
    layout.antennas.resize(plan.layouts.size() + 1);
    for (PlannedAntenna& antenna : layout.antennas) {
      antenna.name = "roof";
      antenna.reader = "reader_1";
      antenna.p_W = {1, 2, 3};
      antenna.boresight_W = -Eigen::Vector3d::UnitZ();
    }
    layout.read = {10.0 * p, 8.0 * p, 10.0 * p};
    layout.places = {p, 1.0};
    plan.layouts.push_back(layout);
  }
  plan.chosen = 0;
  return plan;
}

void put(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  static_cast<void>(folder.with(name, text));
}

std::string complaint_of(const TemporaryFolder& folder) {
  try {
    plan_layer_to_json(folder.path().string());
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(PlanLayer, IsThePlanThatWasWritten) {
  const TemporaryFolder folder;
  EXPECT_FALSE(is_plan_folder(folder.path().string()));
  put(folder, "plan.json", plan_to_json(shop()));
  put(folder, "plan_positions.csv", plan_positions_to_csv(shop()));
  ASSERT_TRUE(is_plan_folder(folder.path().string()));
  const auto json = nlohmann::json::parse(plan_layer_to_json(folder.path().string()));
  EXPECT_EQ(json["counts"], "read at least 3 times");
  EXPECT_EQ(json["chosen"], 0);
  ASSERT_EQ(json["layouts"].size(), 2U);
  EXPECT_EQ(json["layouts"][1]["antennas"][1]["position"], nlohmann::json({1.0, 2.0, 3.0}));
  EXPECT_EQ(json["layouts"][1]["antennas"][1]["boresight"], nlohmann::json({0.0, 0.0, -1.0}));
  EXPECT_EQ(json["layouts"][0]["read"][1], 0.504 * 8.0);
  EXPECT_EQ(json["positions"], nlohmann::json({{0.0, 0.0, 1.0}, {2.0, 1.0, 2.0}}));
  EXPECT_EQ(json["percent"], nlohmann::json({{50, 100}, {100, 100}}));
  EXPECT_EQ(json["colors"].size(), json["edges"].size() + 1);
}

TEST(PlanLayer, FilesThatAreNotWholeAreErrors) {
  const TemporaryFolder folder;
  EXPECT_NE(complaint_of(folder).find("plan.json"), std::string::npos);
  put(folder, "plan.json", "[1, 2");
  put(folder, "plan_positions.csv", plan_positions_to_csv(shop()));
  EXPECT_NE(complaint_of(folder).find("plan.json"), std::string::npos);
  AntennaPlan plan = shop();
  // A table from a plan with fewer antennas.
  plan.layouts.pop_back();
  put(folder, "plan.json", plan_to_json(shop()));
  put(folder, "plan_positions.csv", plan_positions_to_csv(plan));
  EXPECT_NE(complaint_of(folder).find("p_2"), std::string::npos);
  std::string text = plan_positions_to_csv(shop());
  text.replace(text.find("0.5040"), 6, "7.5040");
  put(folder, "plan_positions.csv", text);
  EXPECT_NE(complaint_of(folder).find("plan_positions.csv:2: p_1 is 7.504, expected 0 to 1"),
            std::string::npos);
  std::string json = plan_to_json(shop());
  const std::string chosen = "\"chosen_antennas\": 1";
  json.replace(json.find(chosen), chosen.size(), "\"chosen_antennas\": 7");
  put(folder, "plan.json", json);
  EXPECT_NE(complaint_of(folder).find("chosen_antennas is 7"), std::string::npos);
}

}  // namespace
}  // namespace tagfield
