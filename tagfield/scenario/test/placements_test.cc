// SPDX-License-Identifier: Apache-2.0
#include "tagfield/scenario/placements.h"

#include <gtest/gtest.h>

namespace tagfield {
namespace {

Placement antenna_with(std::vector<RawParameter> parameters) {
  return {"antenna", from_translation({1.0, 2.0, 3.0}), std::move(parameters), {"hall.world", 12}};
}

RawParameter parameter(const std::string& key, const std::string& value) {
  return {key, value, {"hall.world", 20}};
}

TEST(AddPlacements, GivesParametersTheirPublishedMeaning) {
  Scene scene;
  scene.antennas = {antenna_with({parameter("frequency", "915e6"), parameter("noisephi", "0.2"),
                                  parameter("noiserssi", "0.008"), parameter("range", "7"),
                                  parameter("communication_gain", "3"),
                                  parameter("optional_distribution", "normal_distribution"),
                                  parameter("optional_distribution_params", "0.1 0.5"),
                                  parameter("update_rate", "20")})};
  scene.tags = {{"tag1", from_translation({4.0, 5.0, 6.0}), {}, {"hall.world", 30}}};
  Scenario scenario;
  Diagnostics diagnostics;
  add_placements(scene, scenario, diagnostics);
  ASSERT_EQ(scenario.antennas.size(), 1U);
  const AntennaParameters& antenna = scenario.antennas[0].parameters;
  EXPECT_EQ(paper(antenna).model.frequency_hz, 915e6);
  EXPECT_EQ(paper(antenna).model.phase_noise_rad, 0.2);
  EXPECT_EQ(paper(antenna).model.rssi_noise, 0.008);  // the published plugin reads <noisephi> here
  EXPECT_EQ(paper(antenna).range_m, 7.0);
  EXPECT_EQ(paper(antenna).model.communication_gain, 3.0);
  EXPECT_EQ(antenna.rate_hz, 20.0);
  EXPECT_EQ(paper(antenna).model.optional.kind, DistributionKind::kNormal);
  EXPECT_EQ(paper(antenna).model.optional.parameters[1], 0.5);
  EXPECT_EQ(scenario.antennas[0].X_PA.translation, Eigen::Vector3d(1.0, 2.0, 3.0));
  ASSERT_EQ(scenario.tags.size(), 1U);
  EXPECT_EQ(scenario.tags[0].motion.front().X_WB.translation, Eigen::Vector3d(4.0, 5.0, 6.0));
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(AddPlacements, GivesATagItsEpc) {
  Scene scene;
  scene.tags = {{"tag1", {}, {parameter("epc", "E280")}, {"hall.world", 30}}};
  Scenario scenario;
  Diagnostics diagnostics;
  add_placements(scene, scenario, diagnostics);
  EXPECT_EQ(scenario.tags.at(0).id, "E280");
  EXPECT_TRUE(diagnostics.warnings().empty());
}

TEST(AddPlacements, WarnsOfPublishedDefaults) {
  Scene scene;
  scene.antennas = {antenna_with({})};
  Scenario scenario;
  Diagnostics diagnostics;
  add_placements(scene, scenario, diagnostics);
  EXPECT_EQ(paper(scenario.antennas[0].parameters).range_m, 5.0);
  EXPECT_EQ(paper(scenario.antennas[0].parameters).model.communication_gain, 250.0);
  EXPECT_EQ(diagnostics.warnings().size(), 1U);
}

std::string complaint_about(const RawParameter& bad) {
  Scene scene;
  scene.antennas = {antenna_with({bad})};
  Scenario scenario;
  Diagnostics diagnostics;
  try {
    add_placements(scene, scenario, diagnostics);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(AddPlacements, RefusesBadValuesByLine) {
  EXPECT_NE(complaint_about(parameter("frequency", "fast")).find("hall.world:20: <frequency>"),
            std::string::npos);
  EXPECT_NE(complaint_about(parameter("range", "-1")).find("<range> must be"), std::string::npos);
  EXPECT_NE(complaint_about(parameter("noisephi", "nan")).find("<noisephi> is 'nan'"),
            std::string::npos);
  EXPECT_NE(complaint_about(parameter("optional_distribution", "normal")).find("did you mean"),
            std::string::npos);
  EXPECT_NE(complaint_about(parameter("update_rate", "0")).find("<update_rate>"),
            std::string::npos);
}

}  // namespace
}  // namespace tagfield
