// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/sensor_radio.h"

#include <gtest/gtest.h>

#include "tagfield/base/test/error_text.h"
#include "tagfield/settings/radio_settings.h"
#include "tagfield/settings/sensor_parameters.h"

namespace tagfield {
namespace {

using Parameters = std::vector<RawParameter>;

std::shared_ptr<const RadioModel> radio_of(const Parameters& parameters) {
  Diagnostics diagnostics;
  return sensor_radio(parameters, {}, diagnostics);
}

std::string radio_complaint(const RawParameter& bad) {
  return error_of([&] { radio_of({{"model", "multipath", {}}, bad}); });
}

TEST(SensorRadio, IsNoneForThePapersModel) {
  EXPECT_EQ(radio_of({}), nullptr);
  EXPECT_EQ(radio_of({{"model", "paper", {}}, {"frequency", "1e9", {}}}), nullptr);
}

TEST(SensorRadio, IsWhatTheSameSettingsAreInAScenario) {
  Diagnostics diagnostics;
  const Parameters settings = {{"transmit_power_dbm", "27.5", {}}, {"inventory", "gen2", {}}};
  const auto expected = radio_model_from(PropagationModel::kMultipath, settings, {}, diagnostics);
  const auto radio = radio_of(
      {{"model", "multipath", {}}, {"transmit_power_dbm", "27.5", {}}, {"inventory", "gen2", {}}});
  EXPECT_EQ(radio->transmit_power_dbm, expected->transmit_power_dbm);
  EXPECT_EQ(radio->reflection_order, 2);
  EXPECT_TRUE(radio->gen2);
  EXPECT_FALSE(radio_of({{"model", "link_budget", {}}})->effects.reflections);
}

TEST(SensorRadio, TakesThePublishedCarrierUnlessThereIsAPlan) {
  const RawParameter model = {"model", "multipath", {}};
  const RawParameter frequency = {"frequency", "910e6", {}};
  EXPECT_EQ(radio_of({model, frequency})->plan.carriers_hz, (std::vector<double>{910e6}));
  for (const Parameters& both : {Parameters{model, {"channel_plan", "fcc", {}}, frequency},
                                 Parameters{frequency, {"channel_plan", "fcc", {}}, model}}) {
    EXPECT_EQ(radio_of(both)->plan.carriers_hz.size(), 50U);
  }
  EXPECT_EQ(radio_of({model, {"phase_offset", "0.5", {}}})->phase_offset_rad, 0.5);
}

TEST(SensorRadio, SaysWhichElementIsWrong) {
  EXPECT_EQ(radio_complaint({"transmit_power_dbm", "loud", {"hall.world", 7}}),
            "hall.world:7: <transmit_power_dbm> is 'loud', expected a finite number");
  EXPECT_TRUE(contains(radio_complaint({"reflection_order", "9", {"hall.world", 7}}),
                       "hall.world:7: <reflection_order> must be"));
  EXPECT_TRUE(contains(radio_complaint({"without", "noises", {}}), "did you mean 'noise'"));
  EXPECT_EQ(radio_complaint({"model", "magic", {}}),
            "<model> is 'magic', expected paper, link_budget, multipath");
}

TEST(SensorRadio, ReadsBackTheSettingsThatAModelKeeps) {
  const Parameters given = {{"model", "link_budget", {}},
                            {"channel_plan", "etsi_high", {}},
                            {"tari_us", "12.5", {}},
                            {"without", "noise hopping", {}}};
  const auto first = radio_of(given);
  ASSERT_EQ(first->settings.size(), 4U);
  const auto second = radio_of(first->settings);
  EXPECT_EQ(second->plan.name, first->plan.name);
  EXPECT_EQ(second->effects.noise, false);
  EXPECT_EQ(second->effects.hopping, false);
}

TEST(SensorTagModel, IsWhatTheSettingsSay) {
  Diagnostics diagnostics;
  EXPECT_EQ(sensor_tag_model({{"epc", "A", {}}}, {}, diagnostics), nullptr);
  EXPECT_EQ(sensor_tag_model({{"sensitivity_dbm", "-20", {}}}, {}, diagnostics)->sensitivity_dbm,
            -20.0);
  EXPECT_EQ(error_of([&] {
              sensor_tag_model({{"sensitivity_dbm", "x", {}}}, {}, diagnostics);
            }),
            "<sensitivity_dbm> is 'x', expected a finite number");
}

TEST(AntennaFrom, MissesOnlyWhatItsModelNeeds) {
  Diagnostics diagnostics;
  const SensorAntenna antenna = antenna_from("gate", {{"model", "multipath", {}}}, {}, diagnostics);
  EXPECT_TRUE(physical(antenna.parameters));
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0],
            "antenna 'gate' uses the defaults of: <frequency> 8.657e+08, <update_rate> 15");
}

TEST(SensorRadio, RefusesASettingBesideThePapersModel) {
  Diagnostics diagnostics;
  for (const std::vector<RawParameter>& parameters :
       {std::vector<RawParameter>{{"gain_dbi", "6", {"w.sdf", 7}}},
        std::vector<RawParameter>{{"model", "paper", {}}, {"gain_dbi", "6", {"w.sdf", 7}}}}) {
    EXPECT_EQ(error_of([&] {
                sensor_radio(parameters, {"w.sdf", 3}, diagnostics);
              }),
              "w.sdf:7: <gain_dbi> belongs to <model> link_budget or multipath, but the antenna is "
              "simulated by <model> paper");
  }
}

}  // namespace
}  // namespace tagfield
