// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/idle_settings.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tagfield/base/test/error_text.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/settings/radio_settings.h"
#include "tagfield/settings/sensor_radio.h"

namespace tagfield {
namespace {

using Parameters = std::vector<RawParameter>;

const Parameters kWithInventory = {{"inventory", "gen2", {}}};

std::string why(PropagationModel kind, Parameters others, const RawParameter& setting) {
  others.push_back(setting);
  Diagnostics diagnostics;
  const auto model = radio_model_from(kind, others, {}, diagnostics);
  return why_idle(setting.key, *model).value_or("");
}

std::string why(const Parameters& others, const RawParameter& setting) {
  return why(PropagationModel::kMultipath, others, setting);
}

std::string why_of_tag(Parameters others, const RawParameter& setting) {
  others.push_back(setting);
  Diagnostics diagnostics;
  return why_idle(setting.key, *tag_model_from("t", others, {}, diagnostics)).value_or("");
}

TEST(IdleSettings, AnInventorysAreIdleWithoutOne) {
  for (const RawParameter& setting : Parameters{{"session", "s1", {}},
                                                {"start_q", "6", {}},
                                                {"port_dwell_s", "0.1", {}},
                                                {"encoding", "fm0", {}},
                                                {"epc_bits", "128", {}},
                                                {"capture_db", "3", {}}}) {
    EXPECT_EQ(why({}, setting), "without inventory: gen2") << setting.key;
    EXPECT_EQ(why(kWithInventory, setting), "") << setting.key;
  }
  // A user who disables an effect knows that its settings have no effect.
  EXPECT_EQ(why({{"inventory", "gen2", {}}, {"without", "inventory", {}}}, {"session", "s1", {}}),
            "");
}

TEST(IdleSettings, LimitsOfQAreIdleWhereItIsFixed) {
  const Parameters fixed = {{"inventory", "gen2", {}}, {"adaptive_q", "false", {}}};
  EXPECT_EQ(why(fixed, {"max_q", "10", {}}), "with adaptive_q: false");
  EXPECT_EQ(why(fixed, {"start_q", "5", {}}), "");
  EXPECT_EQ(why(kWithInventory, {"max_q", "10", {}}), "");
}

TEST(IdleSettings, OtherPathsAreIdleInALinkBudget) {
  for (const RawParameter& setting : Parameters{
           {"reflection_order", "1", {}}, {"diffraction", "on", {}}, {"diffuse_k_db", "6", {}}}) {
    EXPECT_EQ(why(PropagationModel::kLinkBudget, {}, setting),
              "with model: link_budget; expected multipath")
        << setting.key;
    EXPECT_EQ(why({}, setting), "") << setting.key;
  }
  // They request what applies anyway.
  EXPECT_EQ(why(PropagationModel::kLinkBudget, {}, {"reflection_order", "0", {}}), "");
  EXPECT_EQ(why(PropagationModel::kLinkBudget, {}, {"diffraction", "off", {}}), "");
}

TEST(IdleSettings, OnlyAPatchHasALobe) {
  for (const char* const key : {"beam_width_deg", "vertical_beam_width_deg", "front_to_back_db"}) {
    const RawParameter setting = {key, "30", {}};
    EXPECT_EQ(why({}, setting), "") << key;
    EXPECT_EQ(why({{"pattern", "dipole", {}}, {"gain_dbi", "2", {}}}, setting),
              "with pattern: dipole; expected patch")
        << key;
    EXPECT_EQ(why_of_tag({}, setting), "with pattern: dipole; expected patch") << key;
  }
}

TEST(IdleSettings, ATableHasGainsOfItsOwn) {
  const RawParameter table = {"pattern_table", "0 6 6 180 -12 -12", {}};
  EXPECT_EQ(why({{"pattern", "table", {}}, table}, {"gain_dbi", "3", {}}),
            "with pattern: table, which has its own gains");
  EXPECT_EQ(why({}, table), "with pattern: patch; expected table");
  EXPECT_EQ(why({{"pattern", "table", {}}}, table), "");
}

TEST(IdleSettings, ADipoleIsLinearAndACircleHasNoTilt) {
  EXPECT_EQ(why_of_tag({}, {"polarization", "right_circular", {}}),
            "with pattern: dipole, whose polarization is linear");
  EXPECT_EQ(why_of_tag({}, {"polarization", "linear", {}}), "");
  EXPECT_EQ(why_of_tag({}, {"tilt_deg", "20", {}}), "");
  EXPECT_EQ(why({}, {"tilt_deg", "20", {}}), "with a circular polarization");
  EXPECT_EQ(why({{"polarization", "linear", {}}}, {"tilt_deg", "20", {}}), "");
}

TEST(IdleSettings, OneCarrierIsNotDweltOnAndAPlanHasItsOwn) {
  EXPECT_EQ(why({}, {"dwell_s", "0.1", {}}), "with a single carrier");
  EXPECT_EQ(why({{"channel_plan", "fcc", {}}}, {"dwell_s", "0.1", {}}), "");
  EXPECT_EQ(why({}, {"frequency_hz", "910e6", {}}), "");
  Diagnostics diagnostics;
  for (const RawParameter& other :
       Parameters{{"channel_plan", "fcc", {}}, {"carriers_hz", "866e6", {}}}) {
    const auto model = radio_model_from(PropagationModel::kMultipath,
                                        {{"frequency_hz", "865.7e6", {}}, other}, {}, diagnostics);
    EXPECT_EQ(why_idle("frequency_hz", *model),
              "beside channel_plan or carriers_hz, which name other carriers")
        << other.key;
  }
}

TEST(IdleSettings, NoneIsCalledIdleThatWasNotGiven) {
  Diagnostics diagnostics;
  const auto model = radio_model_from(PropagationModel::kLinkBudget, {}, {}, diagnostics);
  for (const SettingHelp& setting : antenna_settings()) {
    EXPECT_FALSE(why_idle(setting.key, *model)) << setting.key;
  }
}

TEST(IdleSettings, AreReportedOfASensorInItsOwnWords) {
  Diagnostics diagnostics;
  sensor_radio({{"model", "multipath", {}},
                {"frequency", "865.7e6", {}},
                {"channel_plan", "etsi_low", {}},
                {"transmit_power_dbm", "20", {}},
                {"session", "s1", {}}},
               {"hall.world", 7}, diagnostics);
  sensor_tag_model({{"front_to_back_db", "10", {}}}, {"hall.world", 9}, diagnostics);
  EXPECT_EQ(
      diagnostics.warnings(),
      (std::vector<std::string>{
          "hall.world:7: <session> has no effect without inventory: gen2",
          "hall.world:9: <front_to_back_db> has no effect with pattern: dipole; expected patch"}));
}

TEST(ChannelPlan, FixedNeedsACarrierBesideAProfilesSeveral) {
  const auto plan = [](const Parameters& parameters) {
    Diagnostics diagnostics;
    return radio_model_from(PropagationModel::kMultipath, parameters, {}, diagnostics)->plan;
  };
  const RawParameter of_profile = {"channel_plan", "fcc", {}, true};
  const RawParameter fixed = {"channel_plan", "fixed", {}};
  EXPECT_EQ(error_of([&] {
              plan({of_profile, fixed});
            }),
            "channel_plan fixed needs frequency_hz, as a profile gives several carriers");
  EXPECT_EQ(plan({of_profile, {"frequency_hz", "910e6", {}}, fixed}).carriers_hz,
            (std::vector<double>{910e6}));
}

}  // namespace
}  // namespace tagfield
