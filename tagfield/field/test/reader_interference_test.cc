// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/reader_interference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tagfield/base/units.h"

namespace tagfield {
namespace {

constexpr double kChannel = 866.3e6;

RadioWorld open_space() {
  Diagnostics diagnostics;
  return radio_world(Scene{}, {}, diagnostics);
}

RadioModel facing_model() {
  RadioModel model;
  model.antenna.shape = PatternShape::kPatch;
  model.antenna.gain_dbi = 8.0;
  model.antenna.beam_width_rad = model.antenna.vertical_beam_width_rad = radians(65.0);
  model.antenna.polarization = PolarizationKind::kRightCircular;
  model.cable_loss_db = 1.5;
  return model;
}

OtherSender sender_at(const RadioModel& model, const RadioWorld& world, const RigidTransform& X_WA,
                      double frequency_hz, double time_share = 1.0) {
  return {"other", "z", view_from(model, world, X_WA, frequency_hz, 2, 1), time_share};
}

TEST(ReceivedFrom, IsFriisBetweenTheAntennas) {
  const RadioWorld world = open_space();
  const RadioModel model = facing_model();
  const RadioView view = view_from(model, world, {}, kChannel, 1, 1);
  const RigidTransform towards = from_xyz_rpy({6.0, 0.0, 0.0}, {0.0, 0.0, kPi});
  const RigidTransform away = from_translation({6.0, 0.0, 0.0});
  std::vector<RadioPath> paths;
  const double free_db = 20.0 * std::log10(wavelength(kChannel) / (4.0 * kPi * 6.0));
  const auto received = [&](const RigidTransform& X_WA, double offset_hz, double time_share) {
    return received_from(sender_at(model, world, X_WA, kChannel + offset_hz, time_share), view,
                         paths);
  };
  // Two right-circular antennas that face each other match.
  EXPECT_NEAR(to_db(received(towards, 0.0, 1.0).whole_mw), 30.0 + 2.0 * (8.0 - 1.5) + free_db,
              1e-6);
  EXPECT_NEAR(to_db(received(towards, 0.0, 0.25).whole_mw),
              30.0 + 2.0 * (8.0 - 1.5) + free_db - 6.0206, 1e-3);
  EXPECT_LT(received(away, 0.0, 1.0).whole_mw, 0.02 * received(towards, 0.0, 1.0).whole_mw);
  const ReceivedSender next = received(towards, 600e3, 1.0);
  EXPECT_NEAR(next.in_replies_mw / next.whole_mw,
              share_in_replies({SpectrumMask::kDense, 100e3}, 600e3, LinkSettings{}, 250e3), 1e-12);
}

TEST(PowerAtTag, IsTheForwardLinksFromTheSender) {
  const RadioWorld world = open_space();
  const RadioModel model = facing_model();
  const auto kind = default_tag_model();
  const TagEnd tag{*kind, from_translation({2.0, 0.0, 0.0}), 7};
  std::vector<RadioPath> paths;
  const double power_dbm =
      to_db(power_at_tag_mw(sender_at(model, world, {}, kChannel), tag, paths));
  // Circular to linear loses 3.01 dB.
  EXPECT_NEAR(power_dbm,
              30.0 - 1.5 + 8.0 + kDipole_dbi - 3.0103 +
                  20.0 * std::log10(wavelength(kChannel) / (8.0 * kPi)),
              1e-3);
}

/// Whether a detector distinguishes a reader's two levels, 1 and 1 − `depth`, by their midpoint, in
/// the presence of another carrier of amplitude `other` at any phase.
bool envelope_is_known(double depth, double other) {
  const double threshold = 1.0 - 0.5 * depth;
  for (int i = 0; i < 360; ++i) {
    const std::complex<double> beside = std::polar(other, radians(i));
    if (std::abs(1.0 + beside) <= threshold) return false;
    if (std::abs(1.0 - depth + beside) >= threshold) return false;
  }
  return true;
}

TEST(HearsCommands, WhereAnEnvelopeIsKnownBesideAnotherCarrier) {
  constexpr double kDepth = 0.9;
  for (const double ratio_db : {3.0, 6.0, 6.9, 6.98, 8.0, 20.0}) {
    RadioLink link;
    link.tag_dbm = -8.0;
    const Disturbance beside{0.0, from_db(-8.0 - ratio_db)};
    EXPECT_EQ(hears_commands(link, beside), envelope_is_known(kDepth, amplitude_from_db(-ratio_db)))
        << ratio_db;
    EXPECT_NEAR(capture_db(link, beside), ratio_db, 1e-9);
  }
  EXPECT_TRUE(hears_commands(RadioLink{}, {}));
}

}  // namespace
}  // namespace tagfield
