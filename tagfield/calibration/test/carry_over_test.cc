// SPDX-License-Identifier: Apache-2.0
#include "tagfield/calibration/carry_over.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tagfield {
namespace {

/// Calibrations with phase centres at these positions along y, known to 1 mm; x is always the same.
std::vector<Calibration> experiments(const std::vector<double>& y_m) {
  std::vector<Calibration> all;
  for (const double y : y_m) {
    AntennaCalibration antenna;
    antenna.phase_centre_m[0] = {0.03, 0.001, true};
    antenna.phase_centre_m[1] = {y, 0.001, true};
    antenna.phase_centre_m[2] = {0.0, 0.1, false};
    antenna.time_offset_s = {0.0, 0.05, false};
    antenna.noise_rad = 0.1 + y;
    antenna.reads = 100;
    all.push_back({"", false, {{"a", antenna}}});
  }
  return all;
}

TEST(CarryOver, WhatIsTheSameInAllIsKept) {
  Diagnostics diagnostics;
  const Calibration carried = carried_over(experiments({0.01, 0.012, 0.008}), diagnostics);
  const AntennaCalibration& antenna = carried.antennas.at("a");
  EXPECT_TRUE(antenna.phase_centre_m[0].observable);
  EXPECT_NEAR(antenna.phase_centre_m[0].value, 0.03, 1e-12);
  EXPECT_TRUE(antenna.phase_centre_m[1].observable);
  EXPECT_NEAR(antenna.phase_centre_m[1].value, 0.01, 1e-12);
  // By hand: a scatter of 2 mm, times √(1 + 1/3) for one more experiment.
  EXPECT_NEAR(antenna.phase_centre_m[1].sigma, 0.002 * std::sqrt(4.0 / 3.0), 1e-9);
  EXPECT_FALSE(antenna.phase_centre_m[2].observable);
  EXPECT_NEAR(antenna.noise_rad, 0.11, 1e-12);
  EXPECT_EQ(antenna.reads, 300U);
}

TEST(CarryOver, WhatDiffersBetweenExperimentsIsLeftAsItWasAndSaidSo) {
  Diagnostics diagnostics;
  const Calibration carried =
      carried_over(experiments({-0.069, -0.045, 0.085, 0.002, -0.125}), diagnostics);
  const AntennaCalibration& antenna = carried.antennas.at("a");
  EXPECT_FALSE(antenna.phase_centre_m[1].observable);
  EXPECT_EQ(antenna.phase_centre_m[1].value, 0.0);
  EXPECT_GT(antenna.phase_centre_m[1].sigma, 0.05);
  ASSERT_FALSE(diagnostics.warnings().empty());
  EXPECT_NE(diagnostics.warnings().front().find("position y does not carry over"),
            std::string::npos);
}

TEST(CarryOver, OffsetsCarryOverWhereAllAgree) {
  std::vector<Calibration> all = experiments({0.0, 0.0, 0.0});
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double shift = 0.1 * static_cast<double>(i);
    all[i].antennas.at("a").offsets = {{900e6, 6.2 + shift > 6.283 ? shift - 0.083 : 6.2, 0.01, 9},
                                       {901e6, 2.0 * static_cast<double>(i), 0.01, 9}};
  }
  Diagnostics diagnostics;
  const Calibration carried = carried_over(all, diagnostics);
  const std::vector<ChannelOffset>& offsets = carried.antennas.at("a").offsets;
  ASSERT_EQ(offsets.size(), 1U);
  EXPECT_EQ(offsets.front().frequency_hz, 900e6);
  EXPECT_EQ(offsets.front().reads, 27U);
}

TEST(CarryOver, TwoExperimentsAreTooFewAndOtherSignsAreRefused) {
  Diagnostics diagnostics;
  EXPECT_THROW(carried_over(experiments({0.0, 0.0}), diagnostics), Error);
  std::vector<Calibration> all = experiments({0.0, 0.0, 0.0});
  all[1].antennas.at("a").phase_sign = -1;
  EXPECT_TRUE(carried_over(all, diagnostics).antennas.empty());
}

}  // namespace
}  // namespace tagfield
