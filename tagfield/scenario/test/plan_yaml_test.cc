// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/base/units.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/plan_spec.h"

namespace tagfield {
namespace {

const std::string kTags = "  tags: [{name: t, box: [0, 0, 0, 1, 0, 0], spacing_m: 0.5}]\n";
const std::string kMount =
    "    - {name: m, points: [[0, 0, 3]], rpy_deg: [[0, 90, 0]], profiles: [panel_6dbi]";

std::string scenario(const std::string& plan) {
  return "model: link_budget\nduration_s: 3\nplan:\n" + plan;
}

PlanSpec plan_in(const std::string& text) {
  Diagnostics unheard;
  return load_scenario_to_plan(folder_of_test().with("plan.yaml", text), {}, unheard).plan;
}

std::string complaint(const std::string& text) {
  try {
    plan_in(text);
    return "";
  } catch (const Error& error) {
    return error.what();
  }
}

TEST(PlanYaml, SpreadsPlacesAndMounts) {
  const PlanSpec plan =
      plan_in(scenario(kTags + "  mounts:\n" + kMount + ", powers_dbm: [30, 27]}\n" +
                       "    - {name: rail, line: [[0, 0, 2], [2, 0, 2]], spacing_m: 1, "
                       "rpy_deg: [[0, 45, 0], [0, 45, 180]], zone: z}\n"));
  ASSERT_EQ(plan.tags.size(), 1U);
  EXPECT_EQ(plan.tags[0].places.size(), 3U);
  EXPECT_EQ(plan.tags[0].count, 3U);
  ASSERT_EQ(plan.mounts.size(), 4U);
  EXPECT_EQ(plan.mounts[0].name, "m");
  EXPECT_EQ(plan.mounts[0].power_dbm, (std::vector<double>{30.0, 27.0}));
  EXPECT_EQ(plan.mounts[3].name, "rail_3");
  EXPECT_EQ(plan.mounts[3].X_WA.size(), 2U);
  EXPECT_TRUE((plan.mounts[0].X_WA[0].rotation * Eigen::Vector3d::UnitX())
                  .isApprox(-Eigen::Vector3d::UnitZ(), 1e-9));
  EXPECT_DOUBLE_EQ(plan.dwell_s, 3.0);
}

TEST(PlanYaml, RefusesMorePowerIntoTheAntennaThanTheFccAllows) {
  const auto of_power = [](const std::string& power) {
    return complaint(
        "model: link_budget\nplan:\n  tags: [{name: t, points: [[1, 0, 0]]}]\n  mounts:\n"
        "    - {name: m, points: [[0, 0, 2]], rpy_deg: [[0, 0, 0]], channel_plan: fcc, gain_dbi: "
        "2, cable_loss_db: 0.6, "
        "powers_dbm: [" +
        power + "]}\n");
  };
  // 1 W after the cable, though 34 dBm would be 36 dBm EIRP.
  EXPECT_EQ(of_power("30.6"), "");
  EXPECT_NE(of_power("33").find("sends 33 dBm to this antenna, more than the 30.6 dBm that the "
                                "plan fcc allows"),
            std::string::npos)
      << of_power("33");
}

TEST(PlanYaml, WarnsOfSettingsWithoutEffect) {
  Diagnostics diagnostics;
  const std::string path = folder_of_test().with(
      "plan.yaml", scenario("  tags: [{name: t, points: [[1, 0, 0]], beam_width_deg: 40}]\n"
                            "  mounts:\n" +
                            kMount + ", powers_dbm: [27], transmit_power_dbm: 26, start_q: 5}\n"));
  load_scenario_to_plan(path, {}, diagnostics);
  EXPECT_EQ(diagnostics.warnings(),
            (std::vector<std::string>{
                path + ":4: beam_width_deg of plan's tags 't' has no effect with pattern: dipole; "
                       "expected patch",
                path + ":6: start_q of mount 'm' has no effect without inventory: gen2",
                path + ":6: transmit_power_dbm of mount 'm' has no effect beside powers_dbm"}));
}

TEST(PlanYaml, SaysWhatIsWrongWhere) {
  const auto says = [](const std::string& text, const char* words) {
    const std::string said = complaint(text);
    EXPECT_NE(said.find(words), std::string::npos) << said;
    EXPECT_NE(said.find("plan.yaml"), std::string::npos) << said;
  };
  says("model: link_budget\nduration_s: 1\n", "has no 'plan'");
  says(scenario(kTags), "has no 'mounts'");
  says(scenario("  mounts:\n" + kMount + "}\n"), "has no 'tags'");
  says(scenario(kTags + "  mounts: [{name: m, rpy_deg: [[0, 90, 0]]}]\n"), "one of 'points'");
  says(scenario(kTags + "  mounts: [{name: m, points: [[0, 0, 3]]}]\n"), "rpy_deg");
  says(scenario(kTags + "  mounts:\n" + kMount + "}\n" + kMount + "}\n"), "already");
  says(scenario(kTags + "  mounts:\n" + kMount + "}\n  forbidden: [[-1, -1, 1, 1]]\n"),
       "leaves no mount");
  says(scenario(kTags + "  mounts:\n" + kMount +
                ", channel_plan: etsi_low, "
                "powers_dbm: [36]}\n"),
       "more than the");
  says(scenario(kTags + "  mounts:\n" + kMount + "}\n  limits: {antennas: 0}\n"), "1 to 256");
  says(scenario(kTags + "  mounts:\n" + kMount + "}\n  limits: {cross_reads: 2}\n"), "0 to 1");
  says(scenario(kTags + "  mounts:\n" + kMount + "}\n  lmits: {}\n"), "did you mean 'limits'");
  says(scenario("  tags: [{name: t, box: [0, 0, 0, 1e4, 1e4, 1e4]}]\n  mounts:\n" + kMount + "}\n"),
       "greater spacing_m");
  says("duration_s: 1\nplan:\n" + kTags + "  mounts:\n" + kMount + "}\n", "model: multipath");
}

TEST(PlanYaml, TakesTheScenariosOwnTags) {
  const PlanSpec plan = plan_in(scenario("  mounts:\n" + kMount + "}\n") +
                                "tags: [{id: own, position: [1, 2, 3]}]\n");
  ASSERT_EQ(plan.tags.size(), 1U);
  EXPECT_EQ(plan.tags[0].name, "own");
  EXPECT_EQ(plan.tags[0].places[0], Eigen::Vector3d(1, 2, 3));
}

}  // namespace
}  // namespace tagfield
