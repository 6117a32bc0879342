// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/test/world_test.h"

namespace tagfield {
namespace {

class LoadWorldSensors : public WorldTest {
 protected:
  static std::string tag(const std::string& name) {
    return "<sensor name='" + name + "' type='rfidtag'><pose>0 0 0.1 0 0 0</pose></sensor>";
  }
  static std::string model(const std::string& name, const std::string& inside) {
    return "<model name='" + name + "'>" + inside + "</model>";
  }
  static std::string link(const std::string& name, const std::string& inside) {
    return "<link name='" + name + "'>" + inside + "</link>";
  }
  static std::vector<std::string> names(const std::vector<Placement>& placements) {
    std::vector<std::string> result;
    for (const Placement& placement : placements) result.push_back(placement.name);
    return result;
  }
};

/// The form used by the published example for its antennas and tags.
const char* const kPublishedForm = R"(<model name="fixed">
<pose>3.5 -4.0 0 0 0 1.5707963267948966</pose>
<static>true</static>
<link name="link">
<sensor name="antenna" type="rfid">
<always_on>1</always_on>
<update_rate>15</update_rate>
<pose>1 0 2 0 0 0</pose>
<plugin name="reader" filename="libgazeboRfidAntennaPlugin.so">
<frequency> 865.7e6 </frequency>
<!-- radians -->
<noisephi>0.1</noisephi>
<optional_distribution_params>0.5
  1.5</optional_distribution_params>
<empty/>
</plugin>
</sensor>
</link>
</model>
<model name="tag1">
<pose>2.90 0.57 2.05 0 0 0</pose>
<link name="link">
<sensor name="tag" type="rfidtag">
<plugin name="tag" filename="libgazeboRfidTagPlugin.so"/>
</sensor>
</link>
</model>)";

TEST_F(LoadWorldSensors, PublishedFormGivesAntennasTagsAndParameters) {
  const Scene scene = load(kPublishedForm, "1.6");
  ASSERT_EQ(scene.antennas.size(), 1U);
  ASSERT_EQ(scene.tags.size(), 1U);
  EXPECT_TRUE(warnings().empty());
  const Placement& antenna = scene.antennas[0];
  EXPECT_EQ(antenna.name, "antenna");
  EXPECT_EQ(to_string(antenna.location), path_of("world.sdf") + ":7");
  // A rotation by 90° maps (1, 0) to (0, 1).
  EXPECT_LT((antenna.X_WS.translation - Eigen::Vector3d(3.5, -3.0, 2.0)).norm(), 1e-9);
  EXPECT_NEAR(yaw_of(antenna.X_WS.rotation), 1.5707963267948966, 1e-9);
  EXPECT_EQ(scene.tags[0].name, "tag1");  // Its model's name, not the sensor's.
  EXPECT_EQ(scene.tags[0].X_WS.translation, Eigen::Vector3d(2.90, 0.57, 2.05));
  EXPECT_TRUE(scene.tags[0].parameters.empty());
}

TEST_F(LoadWorldSensors, ParametersKeepTextAndLine) {
  const auto parameters = load(kPublishedForm, "1.6").antennas.at(0).parameters;
  ASSERT_EQ(parameters.size(), 5U);
  const std::vector<std::tuple<std::string, std::string, int>> expected = {
      {"frequency", "865.7e6", 12},
      {"noisephi", "0.1", 14},
      {"optional_distribution_params", "0.5 1.5", 15},
      {"empty", "", 17},
      {"update_rate", "15", 9}};
  for (std::size_t i = 0; i < expected.size(); ++i) {
    const auto& [key, value, line] = expected[i];
    EXPECT_EQ(parameters[i].key, key);
    EXPECT_EQ(parameters[i].value, value);
    EXPECT_EQ(to_string(parameters[i].location), path_of("world.sdf") + ":" + std::to_string(line));
  }
}

TEST_F(LoadWorldSensors, ParametersOfAnIncludedModelPointIntoItsFile) {
  write("models/post/model.config",
        "<model><name>post</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("models/post/model.sdf",
        "<sdf version='1.6'><model name='post'><link name='l'>\n<sensor name='a' type='rfid'>\n"
        "<plugin name='p' filename='p.so'>\n<range>7</range></plugin></sensor></link></model>"
        "</sdf>");
  const Scene scene = load("<include><uri>model://post</uri></include>");
  ASSERT_EQ(scene.antennas.size(), 1U);
  ASSERT_EQ(scene.antennas[0].parameters.size(), 1U);
  EXPECT_EQ(to_string(scene.antennas[0].parameters[0].location),
            path_of("models/post/model.sdf") + ":4");
}

TEST_F(LoadWorldSensors, AnAntennaHasItsSensorsNameAndSeveralTagsOfAModelHaveBoth) {
  const Scene scene = load(model("a", link("l", tag("one") + tag("two"))) +
                           model("b", link("l", "<sensor name='one' type='rfid'/>")));
  EXPECT_EQ(names(scene.tags), (std::vector<std::string>{"a::one", "a::two"}));
  EXPECT_EQ(names(scene.antennas), std::vector<std::string>{"one"});
}

TEST_F(LoadWorldSensors, TheOnlyTagOfAModelHasItsName) {
  const Scene scene =
      load(model("a", link("l", tag("tag") + tag("other"))) + model("b", link("l", tag("tag"))) +
           model("c", link("l", "") + model("d", link("l", tag("tag")))));
  EXPECT_EQ(names(scene.tags), (std::vector<std::string>{"a::tag", "a::other", "b", "c::d"}));
}

TEST_F(LoadWorldSensors, NamesSharedWithinAModelAreScopedByTheirLinkToo) {
  const Scene scene = load(model("a", link("k", tag("tag")) + link("l", tag("tag"))) +
                           model("b", link("l", tag("tag"))));
  EXPECT_EQ(names(scene.tags), (std::vector<std::string>{"a::k::tag", "a::l::tag", "b"}));
}

TEST_F(LoadWorldSensors, TagsOfNestedModelsStandInTheWorld) {
  const Scene scene =
      load(model("a", "<pose>1 0 0 0 0 0</pose>" + link("l", "") +
                          model("b", "<pose>0 2 0 0 0 0</pose>" + link("l", tag("tag")))));
  ASSERT_EQ(scene.tags.size(), 1U);
  EXPECT_LT((scene.tags[0].X_WS.translation - Eigen::Vector3d(1.0, 2.0, 0.1)).norm(), 1e-12);
}

TEST_F(LoadWorldSensors, OtherSensorsAreLeftAlone) {
  const Scene scene = load(model("a", link("l", "<sensor name='s' type='imu'/>")));
  EXPECT_TRUE(scene.antennas.empty());
  EXPECT_TRUE(scene.tags.empty());
  EXPECT_TRUE(warnings().empty());
}

}  // namespace
}  // namespace tagfield
