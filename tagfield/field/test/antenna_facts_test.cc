// SPDX-License-Identifier: Apache-2.0
#include "tagfield/field/antenna_facts.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tagfield/base/units.h"
#include "tagfield/channel/antenna_pattern.h"
#include "tagfield/reader/channel_plan.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

AntennaParameters physical_antenna() {
  auto model = std::make_shared<RadioModel>();
  model->plan = fixed_plan(915e6);
  model->antenna.shape = PatternShape::kIsotropic;
  model->antenna.gain_dbi = 0.0;
  model->transmit_power_dbm = 27.0;
  AntennaParameters antenna;
  antenna.model = std::shared_ptr<const RadioModel>(model);
  return antenna;
}

TEST(AntennaFacts, OfThePapersAntennaAreItsParameters) {
  AntennaParameters antenna;
  paper(antenna).range_m = 4.5;
  paper(antenna).model.phase_offset_rad = 0.7;
  EXPECT_FALSE(meets_world(antenna));
  EXPECT_EQ(nominal_range_m(antenna), 4.5);
  EXPECT_EQ(nominal_frequency_hz(antenna), 865.7e6);
  EXPECT_EQ(stated_phase(antenna)->offset_rad, 0.7);
  EXPECT_EQ(stated_phase(antenna)->noise_rad, 0.1);
  EXPECT_FALSE(transmit_power_dbm(antenna));
}

TEST(AntennaFacts, OfAPhysicalAntennaComeFromItsLinkBudget) {
  const AntennaParameters antenna = physical_antenna();
  EXPECT_TRUE(meets_world(antenna));
  EXPECT_EQ(nominal_frequency_hz(antenna), 915e6);
  EXPECT_FALSE(stated_phase(antenna));
  EXPECT_EQ(transmit_power_dbm(antenna), 27.0);
  // 27 dBm + 2.15 dBi − 20 log10(4πd/λ) = −18 dBm, without reflections.
  const double reach_db = 27.0 + 2.15 + 18.0;
  const double expected_m = wavelength(915e6) / (4.0 * kPi) * std::pow(10.0, reach_db / 20.0);
  EXPECT_NEAR(nominal_range_m(antenna), expected_m, 0.02 * expected_m);
}

}  // namespace
}  // namespace tagfield
