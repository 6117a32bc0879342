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

TEST(AntennaFacts, OtherPathsAddToTheLargestRangeOnly) {
  AntennaParameters antenna = physical_antenna();
  const double free_m = nominal_range_m(antenna);
  EXPECT_EQ(largest_range_m(antenna), free_m);
  RadioModel model = *physical(antenna);
  model.effects.reflections = true;
  model.reflection_order = 1;
  antenna.model = std::make_shared<const RadioModel>(model);
  EXPECT_EQ(nominal_range_m(antenna), free_m);
  EXPECT_EQ(largest_range_m(antenna), 2.0 * free_m);
  model.tag_coupling = model.effects.coupling = true;
  antenna.model = std::make_shared<const RadioModel>(model);
  EXPECT_EQ(largest_range_m(antenna), 4.0 * free_m);
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

std::shared_ptr<const TagModel> dipole_tag(double sensitivity_dbm) {
  TagModel tag = *default_tag_model();
  tag.sensitivity_dbm = sensitivity_dbm;
  return std::make_shared<const TagModel>(tag);
}

TEST(AntennaFacts, TheRangeIsThatOfTheMostReadableTag) {
  const AntennaParameters antenna = physical_antenna();
  const double alone_m = nominal_range_m(antenna, {dipole_tag(-18.0)});
  EXPECT_EQ(alone_m, nominal_range_m(antenna));
  EXPECT_EQ(nominal_range_m(antenna, {dipole_tag(-12.0), dipole_tag(-18.0)}), alone_m);
  // 6.02 dB are twice the distance.
  EXPECT_NEAR(nominal_range_m(antenna, {dipole_tag(-11.98)}), 0.5 * alone_m, 1e-3 * alone_m);
}

AntennaParameters patch_with(PolarizationKind polarization) {
  AntennaParameters antenna = physical_antenna();
  RadioModel model = *physical(antenna);
  model.antenna.shape = PatternShape::kPatch;
  model.antenna.beam_width_rad = model.antenna.vertical_beam_width_rad = radians(65.0);
  model.antenna.polarization = polarization;
  antenna.model = std::make_shared<const RadioModel>(model);
  return antenna;
}

// A linear antenna receives half of the power of a circular one, and of a dipole's reply the other
// half is lost.
TEST(AntennaFacts, TheRangeKnowsPolarization) {
  const double linear_m = nominal_range_m(patch_with(PolarizationKind::kLinear));
  for (const PolarizationKind circular :
       {PolarizationKind::kRightCircular, PolarizationKind::kLeftCircular}) {
    EXPECT_NEAR(nominal_range_m(patch_with(circular)), linear_m / std::sqrt(2.0), 1e-9);
  }
  // Crossed wires radiate linearly to their sides, and without polarization nothing is lost.
  AntennaParameters antenna = patch_with(PolarizationKind::kRightCircular);
  RadioModel model = *physical(antenna);
  model.antenna.shape = PatternShape::kIsotropic;
  antenna.model = std::make_shared<const RadioModel>(model);
  EXPECT_NEAR(nominal_range_m(antenna), linear_m, 1e-9);
  model.antenna.shape = PatternShape::kPatch;
  model.effects.polarization = false;
  antenna.model = std::make_shared<const RadioModel>(model);
  EXPECT_NEAR(nominal_range_m(antenna), linear_m, 1e-9);
}

}  // namespace
}  // namespace tagfield
