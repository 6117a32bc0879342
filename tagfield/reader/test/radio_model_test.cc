// SPDX-License-Identifier: Apache-2.0
#include "tagfield/reader/radio_model.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <string>

#include "tagfield/base/units.h"
#include "tagfield/reader/antenna.h"

namespace tagfield {
namespace {

constexpr double kCarrier_hz = 865.7e6;

/// Isotropic, with free-space propagation only.
RadioModel plain_model() {
  RadioModel model;
  model.plan = fixed_plan(kCarrier_hz);
  model.antenna.gain_dbi = 0.0;
  model.transmit_power_dbm = 30.0;
  return model;
}

TagModel plain_tag(double sensitivity_dbm) {
  TagModel tag;
  tag.antenna.gain_dbi = 0.0;
  tag.sensitivity_dbm = sensitivity_dbm;
  tag.modulation_db = -5.0;
  return tag;
}

double free_space_db(double distance_m) {
  return 20.0 * std::log10(4.0 * kPi * distance_m / wavelength(kCarrier_hz));
}

TEST(MostRange, IsWhereTheChipWakesUp) {
  // 30 dBm − L = −18 dBm; a reader of infinite sensitivity could receive the reply from further
  // away.
  RadioModel model = plain_model();
  model.hardware.sensitivity_dbm = -140.0;
  EXPECT_NEAR(free_space_db(max_range_m(model, plain_tag(-18.0))), 48.0, 1e-9);
  // Gains and losses of the forward link.
  model.antenna.gain_dbi = 6.0;
  model.cable_loss_db = 1.5;
  TagModel tag = plain_tag(-18.0);
  tag.antenna.gain_dbi = 2.0;
  tag.detuning_db = 3.0;
  EXPECT_NEAR(free_space_db(max_range_m(model, tag)), 48.0 + 6.0 - 1.5 + 2.0 - 3.0, 1e-9);
}

TEST(MostRange, IsWhereTheReaderStillHears) {
  // 30 − 2 L − 5 = −60 dBm, as a chip that needs almost no power would respond from further away.
  RadioModel model = plain_model();
  model.hardware.sensitivity_dbm = -60.0;
  EXPECT_NEAR(free_space_db(max_range_m(model, plain_tag(-90.0))), 42.5, 1e-9);
  // Antenna gain and cable loss count twice here.
  model.antenna.gain_dbi = 6.0;
  model.cable_loss_db = 1.5;
  EXPECT_NEAR(free_space_db(max_range_m(model, plain_tag(-90.0))), 42.5 + 6.0 - 1.5, 1e-9);
}

TEST(MostRange, IsTwiceThatWhereOtherWavesMayAdd) {
  RadioModel model = plain_model();
  const double alone_m = max_range_m(model, plain_tag(-18.0));
  model.reflection_order = 1;
  EXPECT_NEAR(max_range_m(model, plain_tag(-18.0)), 2.0 * alone_m, 1e-9);
  model.effects.reflections = false;
  EXPECT_NEAR(max_range_m(model, plain_tag(-18.0)), alone_m, 1e-9);
  model.diffuse_k_db = 3.0;
  EXPECT_NEAR(max_range_m(model, plain_tag(-18.0)), 2.0 * alone_m, 1e-9);
}

TEST(TransmitSpectrum, HasTheChannelsOfItsMask) {
  // ISO/IEC 18000-63: in dense mode channels are 2.5/Tari wide, otherwise as in the regulation.
  RadioModel model = plain_model();
  model.gen2.emplace();
  model.gen2->link.tari_s = 25e-6;
  model.plan.channel_hz = 500e3;
  EXPECT_NEAR(transmit_spectrum_of(model).channel_hz, 100e3, 1e-6);
  model.gen2->link.tari_s = 12.5e-6;
  EXPECT_NEAR(transmit_spectrum_of(model).channel_hz, 200e3, 1e-6);
  model.spectrum_mask = SpectrumMask::kMultiple;
  EXPECT_DOUBLE_EQ(transmit_spectrum_of(model).channel_hz, 500e3);
}

TEST(MaySendAtOnce, WhereReadersDontTakeTurns) {
  const auto antenna = [](const std::string& reader, AirSharing sharing) {
    RadioModel model = plain_model();
    model.sharing = sharing;
    AntennaParameters parameters;
    parameters.name = reader + "_1";
    parameters.reader = reader;
    parameters.model = std::make_shared<const RadioModel>(model);
    return parameters;
  };
  const AntennaParameters a = antenna("a", AirSharing::kChannel);
  EXPECT_TRUE(may_send_at_once(a, antenna("b", AirSharing::kChannel)));
  EXPECT_TRUE(may_send_at_once(a, antenna("b", AirSharing::kTime)));
  EXPECT_FALSE(may_send_at_once(antenna("a", AirSharing::kTime), antenna("b", AirSharing::kTime)));
  // Ports of one reader take turns, and the paper's antennas don't share the air.
  EXPECT_FALSE(may_send_at_once(a, antenna("a", AirSharing::kChannel)));
  AntennaParameters of_paper;
  of_paper.reader = "b";
  EXPECT_FALSE(may_send_at_once(a, of_paper));
  EXPECT_FALSE(may_send_at_once(of_paper, a));
}

}  // namespace
}  // namespace tagfield
