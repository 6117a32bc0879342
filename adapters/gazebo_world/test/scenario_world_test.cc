// SPDX-License-Identifier: Apache-2.0
#include "adapters/gazebo_world/scenario_world.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <tinyxml2.h>

#include <cmath>
#include <filesystem>
#include <sstream>

#include "tagfield/base/test/temporary_folder.h"
#include "tagfield/files/files.h"
#include "tagfield/reader/radio_model.h"
#include "tagfield/scenario/placements.h"
#include "tagfield/scenario/scenario_yaml.h"
#include "tagfield/sdf/load_world.h"

namespace tagfield {
namespace {

namespace fs = std::filesystem;
using tinyxml2::XMLElement;

constexpr double kTiny = 1e-9;

fs::path temp(const std::string& name) { return folder_of_test().path() / name; }

GazeboWorldOptions with_p3at() {
  GazeboWorldOptions options;
  options.robot_model = TAGFIELD_SOURCE_DIR "/models/p3at/model.sdf";
  return options;
}

std::string write_scenario(const std::string& yaml) {
  return folder_of_test().with("scenario.yaml", yaml);
}

std::string world_text(const std::string& scenario_path, Diagnostics& diagnostics,
                       const GazeboWorldOptions& options = with_p3at()) {
  const ScenarioWithWorld loaded = load_scenario_with_world(scenario_path, {}, diagnostics);
  return gazebo_world(load_scenario(scenario_path, {}), loaded.scene, options, diagnostics);
}

/// The scenario as a world, and that world as a Scene again.
Scene read_back(const std::string& scenario_path, const GazeboWorldOptions& options = with_p3at()) {
  Diagnostics diagnostics;
  const std::string path = temp("written.world").string();
  write_text_file(path, world_text(scenario_path, diagnostics, options));
  Diagnostics complaints;
  Scene scene = load_world(path, {}, complaints);
  EXPECT_TRUE(complaints.warnings().empty()) << complaints.warnings().front();
  return scene;
}

std::string parameter(const Placement& placement, const std::string& key) {
  for (const RawParameter& parameter : placement.parameters) {
    if (parameter.key == key) return parameter.value;
  }
  return "not given";
}

const Placement* tag_called(const Scene& scene, const std::string& id) {
  for (const Placement& tag : scene.tags) {
    if (parameter(tag, "epc") == id) return &tag;
  }
  return nullptr;
}

TEST(ScenarioWorld, LeavesOutWhatOnlyAProfileSaysAndNothingUses) {
  const auto has_session = [](const std::string& inventory) {
    Diagnostics diagnostics;
    const std::string text = world_text(
        write_scenario(
            "model: link_budget\nduration_s: 1\nantennas:\n  - {name: a, pose: [0, 0, 1], "
            "profiles: [speedway_r420], inventory: " +
            inventory + "}\ntags:\n  - {id: t, position: [2, 0, 1]}\n"),
        diagnostics);
    return text.find("<session>") != std::string::npos;
  };
  EXPECT_TRUE(has_session("gen2"));
  EXPECT_FALSE(has_session("none"));
}

class ScenarioFiles : public testing::TestWithParam<const char*> {};

/// The contents of the world are unchanged, and all of the scenario's tags have the same positions.
TEST_P(ScenarioFiles, AreTheSameInTheWorld) {
  const std::string path = fmt::format("{}/scenarios/{}", TAGFIELD_SOURCE_DIR, GetParam());
  Diagnostics diagnostics;
  const ScenarioWithWorld loaded = load_scenario_with_world(path, {}, diagnostics);
  const Scene scene = read_back(path);
  std::map<std::string, RigidTransform> collisions;
  for (const Collision& collision : scene.collisions) {
    collisions.emplace(collision.name, collision.X_WC);
  }
  for (const Collision& collision : loaded.scene.collisions) {
    const auto found = collisions.find(collision.name);
    ASSERT_NE(found, collisions.end()) << collision.name;
    EXPECT_LT((found->second.translation - collision.X_WC.translation).norm(), kTiny);
  }
  for (const TagSpec& tag : loaded.scenario.tags) {
    const Placement* const placed = tag_called(scene, tag.id);
    if (tag.motion.size() > 1) {
      EXPECT_EQ(placed, nullptr) << tag.id;
      continue;
    }
    ASSERT_NE(placed, nullptr) << tag.id;
    if (!tag.on.empty()) continue;
    EXPECT_EQ(placed->X_WS.translation, tag.motion.front().X_WB.translation) << tag.id;
  }
  EXPECT_EQ(scene.antennas.size(), loaded.scenario.antennas.size());
}

INSTANTIATE_TEST_SUITE_P(All, ScenarioFiles,
                         testing::Values("paper_warehouse.yaml", "two_antennas.yaml", "z_axis.yaml",
                                         "moving_tags.yaml", "spawn.yaml"));

constexpr const char* kPhysical = R"(name: test
seed: 5
duration_s: 1
model: multipath
without: [noise]
materials:
  - {name: foam, permittivity: 1.25, wall_m: 0.02}
world:
  path: hall.world
  materials: {"hall*": foam, door: glass}
  default_material: wood
  min_facet_m2: 0.25
antennas:
  - {name: one, pose: [3, -4, 2], channel_plan: etsi_high, transmit_power_dbm: 27.3, tari_us: 12.5,
     inventory: gen2}
  - {name: two, pose: [3, 4, 2], reader: other, model: link_budget, frequency_hz: 910e6,
     phase_offset_rad: 0.25}
  - {name: three, pose: [3, 6, 2], model: paper, range_m: 6.5}
tags:
  - {id: t, position: [2, 2, 1]}
  - {id: turned, position: [1, 2, 1], rpy: [0, 0.5, 1], sensitivity_dbm: -20.5}
)";

/// A hall for kPhysical, with materials that are not the scenario's.
constexpr const char* kHall = R"(<sdf version="1.6"><world name="w">
  <plugin name="old" filename="libTagfieldMaterialsPlugin.so"/>
  <model name="hall"><static>1</static><link name="link"><collision name="c"><geometry>
    <box><size>1 1 1</size></box></geometry></collision></link></model></world></sdf>)";

std::string write_physical() {
  write_text_file(temp("hall.world").string(), kHall);
  return write_scenario(kPhysical);
}

/// The radio models of a world's sensor are the scenario's.
void expect_same(const RadioModel& read, const RadioModel& given) {
  EXPECT_EQ(read.plan.carriers_hz, given.plan.carriers_hz);
  EXPECT_EQ(read.transmit_power_dbm, given.transmit_power_dbm);
  EXPECT_EQ(read.phase_offset_rad, given.phase_offset_rad);
  EXPECT_EQ(read.reflection_order, given.reflection_order);
  EXPECT_EQ(read.effects.noise, given.effects.noise);
  EXPECT_EQ(read.effects.reflections, given.effects.reflections);
  ASSERT_EQ(read.gen2.has_value(), given.gen2.has_value());
  if (!read.gen2) return;
  EXPECT_EQ(read.gen2->link.tari_s, given.gen2->link.tari_s);
}

TEST(GazeboWorld, HoldsPhysicalModels) {
  const std::string path = write_physical();
  Diagnostics diagnostics;
  const Scenario given = load_scenario(path, {}, diagnostics);
  Scenario read;
  add_placements(read_back(path), read, diagnostics);
  ASSERT_EQ(read.antennas.size(), 3U);
  for (std::size_t i = 0; i < 2; ++i) {
    ASSERT_TRUE(physical(read.antennas[i].parameters));
    expect_same(*physical(read.antennas[i].parameters), *physical(given.antennas[i].parameters));
  }
  EXPECT_EQ(physical(read.antennas[2].parameters), nullptr);
  ASSERT_EQ(read.tags.size(), 2U);
  EXPECT_EQ(read.tags[1].model->sensitivity_dbm, -20.5);
  EXPECT_LT(
      read.tags[1].motion[0].X_WB.rotation.angularDistance(given.tags[1].motion[0].X_WB.rotation),
      kTiny);
}

TEST(GazeboWorld, SaysWhatItIsMadeOfOnce) {
  Diagnostics diagnostics;
  const std::string text = world_text(write_physical(), diagnostics);
  const auto has = [&](const char* part) { return text.find(part) != std::string::npos; };
  EXPECT_FALSE(has("name=\"old\""));
  EXPECT_TRUE(has("<made_of name=\"hall*\">foam</made_of>"));
  EXPECT_TRUE(has("<made_of name=\"door\">glass</made_of>"));
  EXPECT_TRUE(has("<default_material>wood</default_material>"));
  EXPECT_TRUE(has("<min_facet_m2>0.25</min_facet_m2>"));
  EXPECT_TRUE(has("<material name=\"foam\">"));
  EXPECT_TRUE(has("<wall_m>0.02</wall_m>"));
}

constexpr const char* kAntennas = R"(name: test
seed: 77
duration_s: 1
robots:
  - {name: cart, start: [1, 2, 1.5707963267948966], speed_m_s: 0.4, waypoints: [[1, 5], [3, 5]]}
antennas:
  - {name: up, on: cart, pose: [0.1, 0, 1.5, 0.3, 0.2, 0.1], reader: left & right, rate_hz: 20,
     frequency_hz: 915e6, phase_noise_rad: 0.123, phase_offset_rad: 0.5, rssi_noise: 0.01, range_m: 6.5,
     range_sigma: 0.02, communication_gain: 3, optional_distribution: gamma_distribution,
     optional_distribution_params: [2, 0.1]}
  - {name: lifted, on: cart, pose: [0, 0, 0.5], lift: {travel_m: 1.5, speed_m_s: 0.3}}
  - {name: wall, pose: [3, -4, 2, 0, 0.5, 1]}
  - {name: mast, pose: [5, 5, 1], lift: {travel_m: 2}}
tags:
  - {id: t, position: [2, 2, 1]}
  - {id: load, on: cart, position: [0.2, 0, 0.4]}
)";

const Placement& antenna_called(const Scene& scene, const std::string& name) {
  for (const Placement& antenna : scene.antennas) {
    if (parameter(antenna, "antenna") == name) return antenna;
  }
  throw Error("no antenna " + name);
}

TEST(GazeboWorld, AntennasAreWhereAndWhatTheScenarioSays) {
  const std::string path = write_scenario(kAntennas);
  const Scenario scenario = load_scenario(path, {});
  const Scene scene = read_back(path);
  ASSERT_EQ(scene.antennas.size(), 4U);
  const RigidTransform X_WR = from_planar(1.0, 2.0, 1.5707963267948966);
  Scenario read;
  Diagnostics diagnostics;
  add_placements(scene, read, diagnostics);
  for (std::size_t i = 0; i < 4; ++i) {
    const AntennaSpec& antenna = scenario.antennas[i];
    const Placement& placed = antenna_called(scene, antenna.parameters.name);
    const RigidTransform X_WA = antenna.on.empty() ? antenna.X_PA : X_WR * antenna.X_PA;
    EXPECT_LT((placed.X_WS.translation - X_WA.translation).norm(), kTiny);
    EXPECT_LT(placed.X_WS.rotation.angularDistance(X_WA.rotation), 1e-7);
    EXPECT_EQ(parameter(placed, "seed"), "77");
    EXPECT_EQ(parameter(placed, "parent_frame"), antenna.on.empty() ? "not given" : "base_link");
  }
  const Placement& up = antenna_called(scene, "up");
  EXPECT_EQ(parameter(up, "reader"), "left & right");
  EXPECT_EQ(parameter(up, "frequency"), "915000000");
  EXPECT_EQ(parameter(up, "noisephi"), "0.123");
  EXPECT_EQ(parameter(up, "phase_offset"), "0.5");
  EXPECT_EQ(parameter(up, "noiserssi"), "0.01");
  EXPECT_EQ(parameter(up, "range"), "6.5");
  EXPECT_EQ(parameter(up, "range_sigma"), "0.02");
  EXPECT_EQ(parameter(up, "communication_gain"), "3");
  EXPECT_EQ(parameter(up, "optional_distribution"), "gamma_distribution");
  EXPECT_EQ(parameter(up, "optional_distribution_params"), "2 0.1");
  EXPECT_EQ(parameter(up, "update_rate"), "20");
  const Eigen::Vector3d load = tag_called(scene, "load")->X_WS.translation;
  EXPECT_LT((load - Eigen::Vector3d(1.0, 2.2, 0.4)).norm(), kTiny);
}

const XMLElement* model_called(const tinyxml2::XMLDocument& document, const std::string& name) {
  const XMLElement* const world = document.FirstChildElement("sdf")->FirstChildElement("world");
  for (const XMLElement* model = world->FirstChildElement("model"); model != nullptr;
       model = model->NextSiblingElement("model")) {
    if (model->Attribute("name") == name) return model;
  }
  throw Error("no model " + name);
}

const XMLElement* plugin_of(const XMLElement* model, const std::string& file) {
  for (const XMLElement* plugin = model->FirstChildElement("plugin"); plugin != nullptr;
       plugin = plugin->NextSiblingElement("plugin")) {
    if (plugin->Attribute("filename") == file) return plugin;
  }
  throw Error("no plugin " + file);
}

std::string child_text(const XMLElement* element, const char* name) {
  const XMLElement* const child = element->FirstChildElement(name);
  return child == nullptr ? "not given" : child->GetText();
}

TEST(GazeboWorld, ARobotThatFindsItsWayHasNoneAndItsOdometryNoParent) {
  Diagnostics diagnostics;
  const std::string path =
      fmt::format("{}/scenarios/paper_warehouse_slam.yaml", TAGFIELD_SOURCE_DIR);
  tinyxml2::XMLDocument document;
  document.Parse(world_text(path, diagnostics).c_str());
  const XMLElement* const drive =
      plugin_of(model_called(document, "p3at"), "libTagfieldRobotPlugin.so");
  EXPECT_EQ(drive->FirstChildElement("path"), nullptr);
  EXPECT_EQ(drive->FirstChildElement("odom_parent_frame"), nullptr);
}

TEST(GazeboWorld, RobotsHaveTheirWayAndLiftsTheirJoints) {
  Diagnostics diagnostics;
  tinyxml2::XMLDocument document;
  document.Parse(world_text(write_scenario(kAntennas), diagnostics).c_str());
  const XMLElement* const cart = model_called(document, "cart");
  const XMLElement* const drive = plugin_of(cart, "libTagfieldRobotPlugin.so");
  EXPECT_EQ(child_text(drive, "speed"), "0.4");
  const XMLElement* const waypoint =
      drive->FirstChildElement("path")->FirstChildElement("waypoint");
  EXPECT_STREQ(waypoint->GetText(), "1 5");
  EXPECT_STREQ(waypoint->NextSiblingElement("waypoint")->GetText(), "3 5");
  const XMLElement* const lift = plugin_of(cart, "libTagfieldLiftPlugin.so");
  EXPECT_EQ(child_text(lift, "joint"), "lifted_lift_joint");
  EXPECT_EQ(child_text(lift, "speed"), "0.3");
  EXPECT_EQ(child_text(lift, "lower"), "0");
  EXPECT_EQ(child_text(lift, "upper"), "1.5");
  const XMLElement* const mast = model_called(document, "mast");
  EXPECT_EQ(child_text(mast, "static"), "not given");
  EXPECT_EQ(child_text(plugin_of(mast, "libTagfieldLiftPlugin.so"), "upper"), "2");
}

TEST(GazeboWorld, SeveralRobotsHaveFramesOfTheirOwn) {
  std::string yaml = kAntennas;
  yaml.replace(yaml.find("antennas:"), 0, "  - {name: other, start: [4, 4, 0]}\n");
  Diagnostics diagnostics;
  tinyxml2::XMLDocument document;
  document.Parse(world_text(write_scenario(yaml), diagnostics).c_str());
  for (const std::string name : {"cart", "other"}) {
    const XMLElement* const robot = model_called(document, name);
    const XMLElement* const drive = plugin_of(robot, "libTagfieldRobotPlugin.so");
    EXPECT_EQ(child_text(drive, "robotNamespace"), name);
    EXPECT_EQ(child_text(drive, "base_link"), name + "_base_link");
    EXPECT_EQ(child_text(drive, "odom_frame"), name + "_odom");
    EXPECT_EQ(robot->FirstChildElement("link")->Attribute("name"), name + "_base_link");
    EXPECT_EQ(child_text(robot->FirstChildElement("joint"), "parent"), name + "_base_link");
  }
  const Scene scene = read_back(write_scenario(yaml));
  EXPECT_EQ(parameter(antenna_called(scene, "up"), "parent_frame"), "cart_base_link");
}

std::string with_tags(const std::string& tags, const std::string& rest = "") {
  return "duration_s: 1\nantennas: [{name: a, pose: [0, 0, 1]}]\n" + rest + "tags:\n" + tags;
}

TEST(GazeboWorld, IdsMayHaveWhateverXmlCanHold) {
  const std::string id = R"(<b a=\"1\">&amp; 'ä' ::]]> -->)";
  const Scene scene = read_back(write_scenario(with_tags(
      "  - {id: \"" + id +
      "\", position: [1, 2, 3]}\n"
      "  - {id: ground_plane, position: [1, 2, 4]}\n  - {id: world, position: [1, 2, 5]}\n")));
  ASSERT_EQ(scene.tags.size(), 3U);
  EXPECT_NE(tag_called(scene, R"(<b a="1">&amp; 'ä' ::]]> -->)"), nullptr);
  EXPECT_NE(tag_called(scene, "ground_plane"), nullptr);
}

TEST(GazeboWorld, RefusesIdsThatXmlWouldChange) {
  for (const std::string id : {"a\\nb", " a", "a ", "a\\x01"}) {
    const std::string path =
        write_scenario(with_tags("  - {id: \"" + id + "\", position: [1, 2, 3]}\n"));
    Diagnostics diagnostics;
    try {
      world_text(path, diagnostics);
      ADD_FAILURE() << id;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find("scenario.yaml:4"), std::string::npos)
          << error.what();
    }
  }
}

TEST(GazeboWorld, ManyTagsAreOneModelWithATable) {
  std::string rows = "tag,x_m,y_m,z_m\n";
  for (int i = 0; i < 101; ++i) rows += fmt::format("\"<{}>\",{},0.1,1.25\n", i, i);
  write_text_file(temp("tags.csv").string(), rows);
  const std::string path = write_scenario(
      "duration_s: 1\nantennas: [{name: a, pose: [0, 0, 1]}]\ntag_table: tags.csv\n");
  Diagnostics diagnostics;
  tinyxml2::XMLDocument document;
  document.Parse(world_text(path, diagnostics).c_str());
  const XMLElement* const set =
      plugin_of(model_called(document, "tags"), "libTagfieldTagSetPlugin.so");
  int count = 0;
  for (const XMLElement* tag = set->FirstChildElement("tag"); tag != nullptr;
       tag = tag->NextSiblingElement("tag")) {
    EXPECT_EQ(tag->Attribute("epc"), fmt::format("<{}>", count));
    EXPECT_EQ(tag->GetText(), fmt::format("{} 0.1 1.25", count));
    ++count;
  }
  EXPECT_EQ(count, 101);
}

TEST(GazeboWorld, WarnsOfWhatAWorldFileHasNoWordsFor) {
  Diagnostics diagnostics;
  world_text(write_scenario(with_tags("  - {id: moves, trajectory: [[0, 0, 0, 1], [1, 1, 0, 1]]}\n"
                                      "  - {id: comes, position: [0, 0, 1], appears_s: 0.5}\n")),
             diagnostics);
  ASSERT_EQ(diagnostics.warnings().size(), 2U);
  EXPECT_NE(diagnostics.warnings()[0].find("tag 'moves' is left out"), std::string::npos);
  EXPECT_NE(diagnostics.warnings()[1].find("tag 'comes' is there all the time"), std::string::npos);
}

TEST(GazeboWorld, LeavesRecordedAntennasOut) {
  write_text_file(temp("poses.csv").string(),
                  "stamp_s,antenna,x_m,y_m,z_m,qx,qy,qz,qw\n0,b,1,2,3,0,0,0,1\n");
  Diagnostics diagnostics;
  const std::string text = world_text(
      write_scenario("antennas: [{name: a, pose: [0, 0, 1]}, {name: b, recorded: poses.csv}]\n"
                     "tags: [{id: t, position: [1, 2, 3]}]\n"),
      diagnostics);
  EXPECT_EQ(text.find("<antenna>b<"), std::string::npos);
  ASSERT_EQ(diagnostics.warnings().size(), 1U);
  EXPECT_NE(diagnostics.warnings()[0].find("antenna 'b' is left out"), std::string::npos);
}

std::string pace_with(std::optional<double> option, const std::string& rest) {
  GazeboWorldOptions options = with_p3at();
  options.real_time = option;
  Diagnostics diagnostics;
  tinyxml2::XMLDocument document;
  document.Parse(world_text(write_scenario(with_tags("  - {id: t, position: [1, 2, 3]}\n", rest)),
                            diagnostics, options)
                     .c_str());
  const XMLElement* const physics =
      document.FirstChildElement("sdf")->FirstChildElement("world")->FirstChildElement("physics");
  return physics == nullptr ? "none" : child_text(physics, "real_time_update_rate");
}

TEST(GazeboWorld, RunsAtThePaceAskedFor) {
  EXPECT_EQ(pace_with({}, ""), "none");
  EXPECT_EQ(pace_with({}, "real_time: 2\n"), "2000");
  EXPECT_EQ(pace_with(0.0, "real_time: 2\n"), "0");
  EXPECT_EQ(pace_with(0.5, ""), "500");
}

TEST(GazeboWorld, TheWindowLooksAtWhatThereIs) {
  Diagnostics diagnostics;
  tinyxml2::XMLDocument document;
  document.Parse(
      world_text(write_scenario(with_tags("  - {id: t, position: [10, 4, 3]}\n")), diagnostics)
          .c_str());
  const XMLElement* const gui =
      document.FirstChildElement("sdf")->FirstChildElement("world")->FirstChildElement("gui");
  ASSERT_NE(gui, nullptr);
  std::istringstream pose(child_text(gui->FirstChildElement("camera"), "pose"));
  double x = 0.0;
  double y = 0.0;
  double z = 0.0;
  double roll = 0.0;
  double pitch = 0.0;
  pose >> x >> y >> z >> roll >> pitch;
  EXPECT_NEAR(x, 5.0, kTiny);                         // between the antenna at 0 and the tag at 10
  EXPECT_NEAR((2.0 - y) * std::tan(pitch), z, 1e-6);  // the middle of the view is on the floor
  EXPECT_GT(z, 5.0);
}

constexpr const char* kWorldWithMore = R"(<?xml version="1.0"?>
<sdf version="1.6">
  <world name="w">
    <physics type="ode"><max_step_size>0.002</max_step_size></physics>
    <include><uri>crate</uri></include>
    <include><uri>model://crate</uri><name>second</name><pose>0 3 0 0 0 0</pose></include>
    <model name="gate">
      <static>true</static>
      <link name="link">
        <visual name="v"><geometry><mesh><uri>file://media/x.dae</uri></mesh></geometry></visual>
        <sensor name="gate" type="rfid">
          <plugin name="p" filename="libgazeboRfidAntennaPlugin.so"><range>4</range></plugin>
        </sensor>
        <sensor name="own" type="rfidtag">
          <plugin name="p" filename="libgazeboRfidTagPlugin.so"/>
        </sensor>
      </link>
    </model>
    <state world_name="w"><model name="gate"><pose>9 9 9 0 0 0</pose></model></state>
  </world>
</sdf>
)";

constexpr const char* kCrate = R"(<?xml version="1.0"?>
<sdf version="1.6"><model name="crate"><static>true</static><link name="link">
  <collision name="c"><geometry><box><size>1 1 1</size></box></geometry></collision>
</link></model></sdf>
)";

TEST(GazeboWorld, KeepsWhatStandsInTheWorldAndFindsItAgain) {
  fs::create_directories(temp("elsewhere/crate"));
  write_text_file(temp("elsewhere/w.world").string(), kWorldWithMore);
  write_text_file(temp("elsewhere/crate/model.sdf").string(), kCrate);
  write_text_file(temp("elsewhere/crate/model.config").string(),
                  "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  const std::string path = write_scenario(
      with_tags("  - {id: gate, position: [1, 2, 3]}\n", "world: {path: elsewhere/w.world}\n"));
  Diagnostics diagnostics;
  const std::string text = world_text(path, diagnostics);
  EXPECT_NE(text.find("<uri>file://" + temp("elsewhere/crate").string() + "</uri>"),
            std::string::npos);
  EXPECT_NE(text.find("<uri>file://media/x.dae</uri>"), std::string::npos);
  EXPECT_EQ(text.find("<state"), std::string::npos);
  const std::string written = temp("again.world").string();
  write_text_file(written, text);
  Diagnostics complaints;
  const Scene scene = load_world(written, gazebo_model_paths(load_scenario(path, {})), complaints);
  EXPECT_EQ(scene.collisions.size(), 2U);
  ASSERT_EQ(scene.antennas.size(), 2U);
  EXPECT_EQ(parameter(scene.antennas[0], "seed"), "1");
  ASSERT_EQ(scene.tags.size(), 2U);
  EXPECT_EQ(parameter(scene.tags[1], "epc"), "gate");
}

TEST(GazeboWorld, SaysWhatIsWrongWithTheRobotsModel) {
  GazeboWorldOptions options;
  options.robot_model = temp("robot.sdf").string();
  fs::remove(options.robot_model);
  const auto complaint = [&](const std::string& text) -> std::string {
    if (!text.empty()) write_text_file(options.robot_model, text);
    Diagnostics diagnostics;
    try {
      world_text(write_scenario(kAntennas), diagnostics, options);
    } catch (const Error& error) {
      return std::string(error.what()).substr(options.robot_model.size());
    }
    return "none";
  };
  EXPECT_EQ(complaint(""), ": can't be read");
  EXPECT_EQ(complaint("<sdf>\n<model></sdf>"), ":2: malformed XML");
  EXPECT_EQ(complaint("<sdf/>"), ": has no <sdf> with a <model>");
  EXPECT_EQ(complaint("<sdf><model name='m'/></sdf>"),
            ": the model has no libTagfieldRobotPlugin.so");
  EXPECT_EQ(complaint("<sdf><model name='m'><plugin name='p' "
                      "filename='libTagfieldRobotPlugin.so'/></model></sdf>"),
            ": the model has no link 'base_link'");
}

}  // namespace
}  // namespace tagfield
