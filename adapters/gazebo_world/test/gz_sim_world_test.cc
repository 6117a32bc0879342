// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/gz_sim_world.h"

#include <gtest/gtest.h>
#include <tinyxml2.h>

namespace tagfield {
namespace {

using tinyxml2::XMLDocument;
using tinyxml2::XMLElement;

/// The conversion of a world's content, and the warnings.
class Converted {
 public:
  explicit Converted(const std::string& content, const GzSimOptions& options = {}) {
    Diagnostics diagnostics;
    const std::string text =
        gz_sim_world("<sdf version='1.6'>\n<world name='w'>" + content + "</world></sdf>",
                     "old.world", options, diagnostics);
    document_.Parse(text.c_str());
    warnings_ = diagnostics.warnings();
  }

  XMLElement* sdf() { return document_.RootElement(); }
  XMLElement* world() { return document_.RootElement()->FirstChildElement("world"); }
  XMLElement* link() { return world()->FirstChildElement("model")->FirstChildElement("link"); }
  XMLElement* plugin(const std::string& name, XMLElement* in) {
    for (XMLElement* plugin = in->FirstChildElement("plugin"); plugin != nullptr;
         plugin = plugin->NextSiblingElement("plugin")) {
      if (name == plugin->Attribute("name")) return plugin;
    }
    return nullptr;
  }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  XMLDocument document_;
  std::vector<std::string> warnings_;
};

std::string text_in(XMLElement* element, const char* name) {
  const XMLElement* const child = element->FirstChildElement(name);
  return child == nullptr || child->GetText() == nullptr ? "" : child->GetText();
}

TEST(GzSimWorld, MakesCustomSensorsOfOurs) {
  Converted gz(
      "<model name='m'><link name='l'><sensor name='a' type='rfid'><update_rate>15</update_rate>"
      "<plugin name='p' filename='libgazeboRfidAntennaPlugin.so'><range>5</range></plugin></sensor>"
      "<sensor name='t' type='rfidtag'><plugin name='q' filename='libgazeboRfidTagPlugin.so'/>"
      "</sensor></link></model>");
  EXPECT_STREQ(gz.sdf()->Attribute("xmlns:gz"), "http://gazebosim.org/schema");
  XMLElement* const antenna = gz.link()->FirstChildElement("sensor");
  EXPECT_STREQ(antenna->Attribute("type"), "custom");
  EXPECT_STREQ(antenna->Attribute("gz:type"), "rfid_antenna");
  EXPECT_EQ(text_in(antenna, "update_rate"), "15");
  EXPECT_EQ(text_in(antenna->FirstChildElement("gz:rfid_antenna"), "range"), "5");
  EXPECT_EQ(antenna->FirstChildElement("plugin"), nullptr);
  XMLElement* const tag = antenna->NextSiblingElement("sensor");
  EXPECT_STREQ(tag->Attribute("gz:type"), "rfid_tag");
  EXPECT_EQ(tag->FirstChildElement(), nullptr);
  EXPECT_TRUE(gz.warnings().empty());
}

TEST(GzSimWorld, HasSystemsWithOursBehindPhysics) {
  GzSimOptions options;
  options.mcap = "run.mcap";
  Converted gz(
      "<gui/><plugin name='m' filename='libTagfieldMaterialsPlugin.so'>"
      "<made_of name='rack*'>metal</made_of></plugin>",
      options);
  XMLElement* plugin = gz.world()->FirstChildElement("plugin");
  for (const char* const name : {"gz::sim::systems::Physics", "gz::sim::systems::UserCommands",
                                 "gz::sim::systems::SceneBroadcaster", "tagfield::systems::Rfid"}) {
    ASSERT_NE(plugin, nullptr);
    EXPECT_STREQ(plugin->Attribute("name"), name);
    plugin = plugin->NextSiblingElement("plugin");
  }
  EXPECT_EQ(plugin, nullptr);
  XMLElement* const ours = gz.plugin("tagfield::systems::Rfid", gz.world());
  EXPECT_EQ(text_in(ours, "mcap"), "run.mcap");
  EXPECT_EQ(text_in(ours, "made_of"), "metal");
  EXPECT_TRUE(gz.warnings().empty());
}

TEST(GzSimWorld, LeavesSystemsOfItsOwnAlone) {
  Converted gz("<plugin name='gz::sim::systems::Physics' filename='gz-sim-physics-system'/>");
  EXPECT_NE(gz.plugin("gz::sim::systems::Physics", gz.world()), nullptr);
  EXPECT_EQ(gz.plugin("gz::sim::systems::UserCommands", gz.world()), nullptr);
}

TEST(GzSimWorld, KeepsThePace) {
  Converted gz(
      "<physics type='ode'><max_step_size>0.002</max_step_size>"
      "<real_time_update_rate>1000</real_time_update_rate></physics>");
  XMLElement* const physics = gz.world()->FirstChildElement("physics");
  EXPECT_EQ(text_in(physics, "real_time_factor"), "2");
  EXPECT_EQ(physics->FirstChildElement("real_time_update_rate"), nullptr);
}

TEST(GzSimWorld, DrivesRobotsByDiffDrive) {
  GzSimOptions options;
  options.stops_at_end = true;
  Converted gz(
      "<model name='r'><link name='l'><sensor name='s' type='ray'/></link>"
      "<plugin name='p' filename='libTagfieldRobotPlugin.so'><left_joint>a</left_joint>"
      "<right_joint>b</right_joint><track>0.5</track><speed>0.2</speed>"
      "<path><waypoint>1 2</waypoint></path></plugin>"
      "<plugin name='q' filename='libTagfieldLiftPlugin.so'><joint>j</joint></plugin></model>",
      options);
  XMLElement* const robot = gz.world()->FirstChildElement("model");
  XMLElement* const drive = gz.plugin("gz::sim::systems::DiffDrive", robot);
  ASSERT_NE(drive, nullptr);
  EXPECT_EQ(text_in(drive, "left_joint"), "a");
  EXPECT_EQ(text_in(drive, "wheel_separation"), "0.5");
  EXPECT_EQ(text_in(drive, "wheel_radius"), "0.111");
  XMLElement* const way = gz.plugin("tagfield::systems::Waypoints", robot);
  ASSERT_NE(way, nullptr);
  EXPECT_EQ(text_in(way->FirstChildElement("path"), "waypoint"), "1 2");
  EXPECT_EQ(text_in(way, "speed"), "0.2");
  EXPECT_EQ(text_in(way, "stop_at_end"), "true");
  EXPECT_EQ(text_in(gz.plugin("tagfield::systems::Lift", robot), "joint"), "j");
  EXPECT_STREQ(robot->FirstChildElement("link")->FirstChildElement("sensor")->Attribute("type"),
               "gpu_lidar");
  ASSERT_EQ(gz.warnings().size(), 1U);
  EXPECT_EQ(gz.warnings()[0],
            "old.world:2: <sensor name=\"s\"> becomes a gpu_lidar, which needs gz-sim's Sensors "
            "system and graphics");
}

TEST(GzSimWorld, SaysWhatHasNoCounterpart) {
  Converted gz("<model name='r'><plugin name='p' filename='libsomething.so'/></model>");
  ASSERT_EQ(gz.warnings().size(), 1U);
  EXPECT_EQ(gz.warnings()[0],
            "old.world:2: <plugin name=\"p\"> is left out: gz-sim has no such plugin");
  Converted populated("<population name='boxes'><model name='box'/></population>");
  ASSERT_EQ(populated.warnings().size(), 1U);
  EXPECT_EQ(populated.warnings()[0],
            "old.world:2: <population name=\"boxes\"> is left out: gz-sim has no populations");
  EXPECT_EQ(populated.world()->FirstChildElement("population"), nullptr);
  Diagnostics diagnostics;
  EXPECT_THROW(gz_sim_world("<world/>", "a.world", {}, diagnostics), Error);
  EXPECT_THROW(gz_sim_world("<sdf", "a.world", {}, diagnostics), Error);
}

}  // namespace
}  // namespace tagfield
