// SPDX-License-Identifier: Apache-2.0
#include "tagfield/settings/radio_settings.h"

#include <gtest/gtest.h>

#include <fstream>
#include <iterator>

#include "tagfield/base/units.h"
#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/gen2/link_timing.h"
#include "tagfield/gen2/session.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

const Location kHere{"s.yaml", 3};

std::vector<RawParameter> of(const std::vector<std::pair<std::string, std::string>>& pairs) {
  std::vector<RawParameter> parameters;
  int line = 10;
  for (const auto& [key, value] : pairs) parameters.push_back({key, value, {"s.yaml", line++}});
  return parameters;
}

std::shared_ptr<const RadioModel> made(
    const std::vector<std::pair<std::string, std::string>>& pairs,
    PropagationModel model = PropagationModel::kMultipath) {
  Diagnostics diagnostics;
  return radio_model_from(model, of(pairs), kHere, diagnostics);
}

std::string complaint(const std::vector<std::pair<std::string, std::string>>& pairs) {
  try {
    made(pairs);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(RadioModelFrom, TakesValuesInTheirUnits) {
  const auto model = made({{"pattern", "patch"},
                           {"gain_dbi", "8.5"},
                           {"beam_width_deg", "60"},
                           {"vertical_beam_width_deg", "50"},
                           {"polarization", "linear"},
                           {"tilt_deg", "90"},
                           {"channel_plan", "fcc"},
                           {"reflection_order", "3"},
                           {"inventory", "gen2"},
                           {"tari_us", "12.5"},
                           {"blf_khz", "320"},
                           {"encoding", "miller2"},
                           {"divide_ratio", "64/3"},
                           {"session", "s1"},
                           {"without", "noise hopping"},
                           {"receive_pose", "0 0.5 0"}});
  EXPECT_EQ(model->antenna.gain_dbi, 8.5);
  EXPECT_DOUBLE_EQ(model->antenna.beam_width_rad, radians(60));
  EXPECT_DOUBLE_EQ(model->antenna.vertical_beam_width_rad, radians(50));
  EXPECT_DOUBLE_EQ(model->antenna.tilt_rad, kPi / 2);
  EXPECT_EQ(model->plan.carriers_hz.size(), 50U);
  EXPECT_EQ(model->reflection_order, 3);
  ASSERT_TRUE(model->gen2);
  EXPECT_DOUBLE_EQ(model->gen2->link.tari_s, 12.5e-6);
  EXPECT_DOUBLE_EQ(model->gen2->link.blf_hz, 320e3);
  EXPECT_EQ(model->gen2->link.encoding, Encoding::kMiller2);
  EXPECT_EQ(model->gen2->inventory.session, Session::kS1);
  EXPECT_FALSE(model->effects.noise);
  EXPECT_FALSE(model->effects.hopping);
  EXPECT_TRUE(model->effects.quantization);
  EXPECT_EQ(model->X_AR->translation.y(), 0.5);
}

TEST(RadioModelFrom, HasReadersAndTagsToThemselvesUnlessAsked) {
  EXPECT_FALSE(made({})->interference);
  EXPECT_FALSE(made({})->tag_coupling);
  EXPECT_EQ(made({})->spectrum_mask, SpectrumMask::kDense);
  const auto model =
      made({{"interference", "on"}, {"tag_coupling", "on"}, {"spectrum_mask", "multiple"}});
  EXPECT_TRUE(is_disturbed(*model));
  EXPECT_TRUE(couples_tags(*model));
  EXPECT_EQ(model->spectrum_mask, SpectrumMask::kMultiple);
  const auto without =
      made({{"interference", "on"}, {"tag_coupling", "on"}, {"without", "interference coupling"}});
  EXPECT_FALSE(is_disturbed(*without));
  EXPECT_FALSE(couples_tags(*without));
  EXPECT_EQ(complaint({{"spectrum_mask", "wide"}}),
            "s.yaml:10: spectrum_mask is 'wide', expected multiple, dense");
}

TEST(TransmitSpectrumOf, HasChannelsOfTariOrOfThePlan) {
  EXPECT_DOUBLE_EQ(
      transmit_spectrum_of(*made({{"inventory", "gen2"}, {"tari_us", "12.5"}})).channel_hz, 200e3);
  EXPECT_DOUBLE_EQ(
      transmit_spectrum_of(*made({{"channel_plan", "fcc"}, {"spectrum_mask", "multiple"}}))
          .channel_hz,
      500e3);
}

TEST(RadioModelFrom, LetsTheLaterOfTwoCount) {
  EXPECT_EQ(made({{"gain_dbi", "6"}, {"gain_dbi", "7"}})->antenna.gain_dbi, 7.0);
}

TEST(RadioModelFrom, LinkBudgetHasNoOtherPaths) {
  const auto model = made({{"reflection_order", "2"}}, PropagationModel::kLinkBudget);
  EXPECT_FALSE(model->effects.reflections);
  EXPECT_FALSE(model->effects.diffuse);
  EXPECT_EQ(made({})->reflection_order, 2);
  EXPECT_FALSE(made({})->gen2);
}

TEST(RadioModelFrom, NamesPlaceAndRangeOfWhatIsWrong) {
  EXPECT_EQ(complaint({{"gain_dbi", "much"}}),
            "s.yaml:10: gain_dbi is 'much', expected a finite number");
  EXPECT_EQ(complaint({{"start_q", "4"}, {"inventory", "gen2"}, {"start_q", "16"}}),
            "s.yaml:12: start_q must be from 0 to 15, is 16");
  EXPECT_EQ(complaint({{"pattern", "dish"}}),
            "s.yaml:10: pattern is 'dish', expected isotropic, patch, dipole, table");
  EXPECT_EQ(complaint({{"reflection_order", "4"}}),
            "s.yaml:10: reflection_order must be from 0 to 3, is 4");
  EXPECT_EQ(complaint({{"sensitivity_dbm", "29"}, {"transmit_power_dbm", "27"}}),
            "s.yaml:10: sensitivity_dbm must be below transmit_power_dbm (27), is 29");
  EXPECT_EQ(complaint({{"without", "nois"}}),
            "s.yaml:10: without there is no effect 'nois' (did you mean 'noise'?)");
  EXPECT_EQ(complaint({{"channel_plan", "etsi_low"}, {"carriers_hz", "865.7e6 915e6"}}),
            "s.yaml:3: carrier 915 MHz is outside the plan's band, 865 to 868 MHz");
  EXPECT_NE(complaint({{"inventory", "gen2"}, {"tari_us", "5"}}), "");
}

TEST(RadioModelFrom, WarnsOfMorePowerThanThePlanAllows) {
  Diagnostics diagnostics;
  radio_model_from(PropagationModel::kLinkBudget,
                   of({{"channel_plan", "etsi_low"}, {"transmit_power_dbm", "33"}}), kHere,
                   diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0],
            "s.yaml:3: 41.0 dBm EIRP is more than the 35.2 dBm that the channel plan 'etsi_low' "
            "allows");
}

TEST(RadioModelFrom, WarnsOfMorePowerIntoTheAntennaThanTheFccAllows) {
  const auto warnings = [](const std::string& cable_db, const std::string& carriers_hz) {
    std::vector<RawParameter> settings = of({{"channel_plan", "fcc"},
                                             {"transmit_power_dbm", "31"},
                                             {"gain_dbi", "2"},
                                             {"cable_loss_db", cable_db}});
    if (!carriers_hz.empty()) {
      const std::vector<RawParameter> carriers = of({{"carriers_hz", carriers_hz}});
      settings.insert(settings.end(), carriers.begin(), carriers.end());
    }
    Diagnostics diagnostics;
    radio_model_from(PropagationModel::kLinkBudget, settings, kHere, diagnostics);
    return diagnostics.warnings();
  };
  EXPECT_EQ(warnings("1", ""), std::vector<std::string>{});
  EXPECT_EQ(warnings("0.6", ""),
            std::vector<std::string>{"s.yaml:3: 30.4 dBm into the antenna is more than the 30.0 "
                                     "dBm that the channel plan 'fcc' allows with 50 carriers"});
  EXPECT_EQ(warnings("1", "905e6 915e6"),
            std::vector<std::string>{"s.yaml:3: 30.0 dBm into the antenna is more than the 24.0 "
                                     "dBm that the channel plan 'fcc' allows with 2 carriers"});
}

TEST(TagModelFrom, TakesValuesAndChecksThem) {
  Diagnostics diagnostics;
  const auto tag =
      tag_model_from("t", of({{"sensitivity_dbm", "-20"}, {"gain_dbi", "1"}}), kHere, diagnostics);
  EXPECT_EQ(tag->sensitivity_dbm, -20.0);
  EXPECT_EQ(tag->antenna.shape, PatternShape::kDipole);
  EXPECT_THROW(tag_model_from("t", of({{"modulation_db", "3"}}), kHere, diagnostics), Error);
}

TEST(Settings, AllHaveAKeyOfTheirOwnAndSayWhatTheyAre) {
  for (const auto* settings : {&antenna_settings(), &tag_settings()}) {
    std::vector<std::string> keys;
    for (const SettingHelp& setting : *settings) {
      EXPECT_EQ(std::count(keys.begin(), keys.end(), setting.key), 0) << setting.key;
      keys.push_back(setting.key);
      EXPECT_FALSE(setting.meaning.empty()) << setting.key;
    }
  }
  EXPECT_TRUE(is_antenna_setting("cable_loss_db"));
  EXPECT_FALSE(is_tag_setting("cable_loss_db"));
}

TEST(Settings, StandInTheirDocumentationWordForWord) {
  std::ifstream file(TAGFIELD_SOURCE_DIR "/docs/radio_settings.md");
  const std::string page((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  for (const auto* settings : {&antenna_settings(), &tag_settings()}) {
    for (const SettingHelp& setting : *settings) {
      EXPECT_NE(page.find("| `" + setting.key + "` | "), std::string::npos) << setting.key;
      EXPECT_NE(page.find(" | " + setting.meaning + " |"), std::string::npos) << setting.key;
    }
  }
}

}  // namespace
}  // namespace tagfield
