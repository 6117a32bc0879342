// SPDX-License-Identifier: Apache-2.0
#include "adapters/gz/custom_sensor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <sdf/Link.hh>
#include <sdf/Model.hh>
#include <sdf/Root.hh>

#include "adapters/gazebo_common/sensor_names.h"
#include "adapters/gazebo_common/tag_set.h"
#include "adapters/gazebo_common/world_materials.h"

namespace tagfield {
namespace {

/// The first sensor of a model with one link that contains `sensor`.
sdf::Sensor sensor_of(const std::string& sensor) {
  sdf::Root root;
  const std::string text =
      "<sdf version='1.8'><model name='m'><link name='l'>" + sensor + "</link></model></sdf>";
  const sdf::Errors errors = root.LoadSdfString(text);
  EXPECT_TRUE(errors.empty());
  return *root.Model()->LinkByIndex(0)->SensorByIndex(0);
}

/// The value of the last parameter with this key; "" if there is none.
std::string value_of(const std::string& key, const std::vector<RawParameter>& parameters) {
  const auto found =
      std::find_if(parameters.rbegin(), parameters.rend(),
                   [&](const RawParameter& parameter) { return parameter.key == key; });
  return found == parameters.rend() ? "" : found->value;
}

TEST(CustomSensor, HasItsTypeAndParametersUnderEitherPrefix) {
  for (const std::string prefix : {"gz", "ignition"}) {
    const sdf::Sensor sensor =
        sensor_of("<sensor name='s' type='custom' " + prefix +
                  ":type='rfid_antenna'><update_rate>12.5</update_rate><" + prefix +
                  ":rfid_antenna><range>5</range><model>link_budget</model></" + prefix +
                  ":rfid_antenna></sensor>");
    EXPECT_EQ(type_of(sensor), kAntennaType);
    const std::vector<RawParameter> parameters = parameters_of(sensor.Element(), kAntennaType);
    EXPECT_EQ(value_of("range", parameters), "5");
    EXPECT_EQ(value_of("model", parameters), "link_budget");
    EXPECT_EQ(std::stod(value_of("update_rate", parameters)), 12.5);
  }
}

TEST(CustomSensor, OfSomebodyElseIsNoneOfOurs) {
  EXPECT_EQ(type_of(sensor_of("<sensor name='s' type='custom' gz:type='odometer'/>")), "odometer");
  EXPECT_EQ(type_of(sensor_of("<sensor name='s' type='imu'/>")), "");
}

TEST(CustomSensor, WithoutParametersHasNone) {
  const sdf::Sensor sensor = sensor_of("<sensor name='s' type='custom' gz:type='rfid_tag'/>");
  EXPECT_TRUE(parameters_of(sensor.Element(), kTagType).empty());
}

TEST(CustomSensor, TellsOfElementsWithoutEffect) {
  const sdf::Sensor sensor = sensor_of(
      "<sensor name='s' type='custom' gz:type='rfid_antenna'><topic>mine</topic></sensor>");
  Diagnostics diagnostics;
  warn_of_silent(sensor.Element(), diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_EQ(diagnostics.warnings()[0], "<topic> has no effect: reads are on /rfid/reads");
}

sdf::ElementPtr set_of(const std::string& content) {
  return described_in(sensor_of("<sensor name='s' type='custom' gz:type='rfid_tag_set'>"
                                "<gz:rfid_tag_set>" +
                                content + "</gz:rfid_tag_set></sensor>")
                          .Element(),
                      kTagSetType);
}

TEST(TagSet, HasRowsThenTables) {
  const std::string table = testing::TempDir() + "tags.csv";
  std::ofstream(table) << "epc,x_m,y_m,z_m\nC,7,8,9\n";
  Diagnostics diagnostics;
  const std::vector<TagOnLink> tags = tag_set_in(
      set_of("<tag epc='A'>1 2 3</tag><tag epc='B'>0 0 0 0 0 1.5707963267948966</tag>"
             "<table>model://shelf/tags.csv</table><sensitivity_dbm>-20</sensitivity_dbm>"),
      {}, [&](const std::string& uri) { return uri == "model://shelf/tags.csv" ? table : ""; },
      diagnostics);
  EXPECT_TRUE(diagnostics.warnings().empty());
  ASSERT_EQ(tags.size(), 3U);
  EXPECT_EQ(tags[0].id, "A");
  EXPECT_EQ(tags[0].X_LT.translation, Eigen::Vector3d(1.0, 2.0, 3.0));
  // A rotation by 90° about z maps x to y.
  EXPECT_TRUE(
      (tags[1].X_LT.rotation * Eigen::Vector3d::UnitX()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  EXPECT_EQ(tags[2].X_LT.translation, Eigen::Vector3d(7.0, 8.0, 9.0));
  EXPECT_TRUE(tags[0].model && tags[0].model == tags[2].model);
}

TEST(TagSet, SaysWhatIsWrong) {
  const auto nowhere = [](const std::string&) { return std::string(); };
  Diagnostics diagnostics;
  EXPECT_THROW(tag_set_in(set_of("<tag epc='A'>1 2</tag>"), {}, nowhere, diagnostics), Error);
  EXPECT_THROW(tag_set_in(set_of("<tag>1 2 3</tag>"), {}, nowhere, diagnostics), Error);
  EXPECT_THROW(tag_set_in(set_of("<table>a.csv</table>"), {}, nowhere, diagnostics), Error);
  EXPECT_TRUE(diagnostics.warnings().empty());
  EXPECT_TRUE(tag_set_in(set_of("<tagg>1</tagg>"), {}, nowhere, diagnostics).empty());
  EXPECT_EQ(diagnostics.warnings(),
            (std::vector<std::string>{"<tagg> is not known and left out", "has no tags"}));
}

TEST(SensorNames, AreAsShortAsTheyAreUnique) {
  const SensorPlace at{"shelf", "board", "tag"};
  EXPECT_EQ(tag_id_of(at, {"tag"}), "shelf");
  EXPECT_EQ(tag_id_of(at, {"tag", "other"}), "shelf::tag");
  EXPECT_EQ(tag_id_of(at, {"tag", "tag"}), "shelf::board::tag");
  EXPECT_EQ(place_of(at), "model 'shelf', link 'board', sensor 'tag'");
}

}  // namespace
}  // namespace tagfield
