// SPDX-License-Identifier: Apache-2.0
#include "tagfield/live/reader_duty.h"

#include <gtest/gtest.h>

#include "tagfield/base/error.h"
#include "tagfield/reader/radio_model.h"

namespace tagfield {
namespace {

AntennaParameters physical_antenna(bool takes_inventory) {
  auto model = std::make_shared<RadioModel>();
  model->plan = known_plan("etsi_low");
  if (takes_inventory) model->gen2 = Gen2Reader{};
  AntennaParameters antenna;
  antenna.name = "port_1";
  antenna.model = std::shared_ptr<const RadioModel>(std::move(model));
  return antenna;
}

TEST(ReaderDuty, ReplacesWhatItNamesAndNothingElse) {
  ReaderDuty duty;
  duty.antennas = {{"port_1", 21.5}};
  duty.session = Session::kS2;
  duty.target = Target::kAlternate;
  duty.start_q = 7;
  std::vector<std::string> warnings;
  const AntennaParameters before = physical_antenna(true);
  const AntennaParameters changed = on_duty(before, duty, warnings);
  const RadioModel& model = *physical(changed);
  EXPECT_EQ(model.transmit_power_dbm, 21.5);
  EXPECT_EQ(model.gen2->inventory.session, Session::kS2);
  EXPECT_EQ(model.gen2->inventory.target, Target::kAlternate);
  EXPECT_EQ(model.gen2->inventory.start_q, 7);
  EXPECT_EQ(model.plan.carriers_hz, physical(before)->plan.carriers_hz);
  EXPECT_EQ(model.gen2->link.blf_hz, physical(before)->gen2->link.blf_hz);
  EXPECT_TRUE(warnings.empty());
  EXPECT_EQ(physical(before)->transmit_power_dbm, 30.0);  // the antenna itself is unchanged
}

TEST(ReaderDuty, WarnsOfWhatHasNoEffect) {
  ReaderDuty duty;
  duty.antennas = {{"port_1", 20.0}};
  AntennaParameters of_the_paper;
  of_the_paper.name = "port_1";
  std::vector<std::string> warnings;
  on_duty(of_the_paper, duty, warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("paper's model"), std::string::npos);

  warnings.clear();
  duty.session = Session::kS1;
  on_duty(physical_antenna(false), duty, warnings);
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("no inventory"), std::string::npos);

  warnings.clear();
  on_duty(of_the_paper, {{{"port_1", std::nullopt}}, {}, {}, {}, {}, {}, {}}, warnings);
  EXPECT_TRUE(warnings.empty());
}

TEST(ReaderDuty, RefusesWhatIsOutOfRange) {
  std::vector<std::string> warnings;
  ReaderDuty duty;
  duty.antennas = {{"port_1", 1e9}};
  EXPECT_THROW(on_duty(physical_antenna(true), duty, warnings), Error);
  duty.antennas = {{"port_1", std::nullopt}};
  duty.start_q = 16;
  EXPECT_THROW(on_duty(physical_antenna(true), duty, warnings), Error);
  duty.start_q.reset();
  duty.antennas = {{"another", std::nullopt}};
  EXPECT_THROW(on_duty(physical_antenna(true), duty, warnings), Error);
}

}  // namespace
}  // namespace tagfield
