// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/sensor_parameters.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"

namespace tagfield {
namespace {

SensorAntenna antenna_with(const std::vector<RawParameter>& parameters) {
  Diagnostics diagnostics;
  return antenna_from("gate", parameters, {}, diagnostics);
}

std::string complaint_about(const RawParameter& bad) {
  return error_of([&] { antenna_with({bad}); });
}

TEST(AntennaFrom, HasThePublishedDefaults) {
  const SensorAntenna antenna = antenna_with({});
  EXPECT_EQ(paper(antenna.parameters).model.frequency_hz, 865.7e6);
  EXPECT_EQ(paper(antenna.parameters).model.phase_noise_rad, 0.1);
  EXPECT_EQ(paper(antenna.parameters).model.rssi_noise, 0.005);
  EXPECT_EQ(paper(antenna.parameters).model.communication_gain, 250.0);
  EXPECT_EQ(paper(antenna.parameters).model.optional.kind, DistributionKind::kNone);
  EXPECT_EQ(paper(antenna.parameters).range_m, 5.0);
  EXPECT_EQ(paper(antenna.parameters).range_sigma, 0.05);
  EXPECT_EQ(antenna.parameters.name, "gate");
  EXPECT_EQ(antenna.parameters.reader, "gate");
  EXPECT_EQ(antenna.frame_id, "gate");
  EXPECT_EQ(antenna.parent_frame, "");
  EXPECT_EQ(antenna.seed, 1U);
}

TEST(AntennaFrom, TakesTagfieldsOwnParameters) {
  const SensorAntenna antenna = antenna_with({{"antenna", "a1", {}},
                                              {"reader", "r1", {}},
                                              {"phase_offset", "0.5", {}},
                                              {"range_sigma", "0", {}},
                                              {"sensitivity_dbm", "-70", {}},
                                              {"seed", "18446744073709551615", {}},
                                              {"model", "paper", {}},
                                              {"frame_id", "a1_frame", {}},
                                              {"parent_frame", "base_link", {}},
                                              {"robotNamespace", "robot1", {}}});
  EXPECT_EQ(antenna.parameters.name, "a1");
  EXPECT_EQ(antenna.parameters.reader, "r1");
  EXPECT_EQ(paper(antenna.parameters).model.phase_offset_rad, 0.5);
  EXPECT_EQ(paper(antenna.parameters).range_sigma, 0.0);
  EXPECT_EQ(paper(antenna.parameters).sensitivity_dbm, -70.0);
  EXPECT_EQ(antenna.seed, ~std::uint64_t{0});
  EXPECT_EQ(antenna.frame_id, "a1_frame");
  EXPECT_EQ(antenna.parent_frame, "base_link");
  EXPECT_EQ(antenna.name_space, "robot1");
}

TEST(AntennaFrom, NamesTheReaderAfterTheAntenna) {
  EXPECT_EQ(antenna_with({{"antenna", "a1", {}}}).parameters.reader, "a1");
}

TEST(AntennaFrom, SaysWhichParameterIsWrong) {
  EXPECT_EQ(complaint_about({"range", "-1", {}}),
            "antenna 'gate': <range> must be a finite number greater than 0, is -1");
  EXPECT_EQ(complaint_about({"noisephi", "much", {"hall.world", 7}}),
            "hall.world:7: <noisephi> is 'much', expected a number");
  EXPECT_TRUE(contains(complaint_about({"seed", "-1", {}}), "<seed> is '-1'"));
  EXPECT_TRUE(contains(complaint_about({"seed", "1.5", {}}), "<seed> is '1.5'"));
  EXPECT_EQ(complaint_about({"model", "magic", {}}),
            "<model> is 'magic', expected paper, link_budget, multipath");
  EXPECT_TRUE(contains(complaint_about({"optional_distribution", "normal_distribution", {}}),
                       "<optional_distribution>: normal_distribution takes 2 parameters"));
}

TEST(AntennaFrom, WarnsOfWhatItDoesNotKnow) {
  Diagnostics diagnostics;
  antenna_from("gate", {{"freqency", "1e9", {}}}, {}, diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 2U);
  EXPECT_TRUE(contains(diagnostics.warnings()[1], "<freqency> is not known"));
  EXPECT_TRUE(contains(diagnostics.warnings()[1], "frequency"));
}

TEST(TagFrom, HasNoIdAndNoKindUnlessGiven) {
  Diagnostics diagnostics;
  EXPECT_EQ(tag_from({}, {}, diagnostics).epc, std::nullopt);
  EXPECT_EQ(tag_from({}, {}, diagnostics).model, nullptr);
  EXPECT_EQ(tag_from({{"epc", "E280", {}}}, {}, diagnostics).epc, "E280");
  EXPECT_TRUE(diagnostics.warnings().empty());
  EXPECT_TRUE(contains(error_of([&] { tag_from({{"epc", "", {}}}, {}, diagnostics); }), "<epc>"));
}

}  // namespace
}  // namespace tagfield
