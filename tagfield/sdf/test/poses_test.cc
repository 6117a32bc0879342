// SPDX-License-Identifier: Apache-2.0
#include <map>
#include <numbers>

#include "tagfield/sdf/test/world_test.h"

namespace tagfield {
namespace {

/// Expected poses are computed by hand: a rotation by 90° about z maps (x, y) to (-y, x).
class LoadWorldPoses : public WorldTest {
 protected:
  static std::string ball(const std::string& name, const std::string& pose) {
    return "<collision name='" + name + "'>" + pose +
           "<geometry><sphere><radius>1</radius></sphere></geometry></collision>";
  }

  static void expect_pose(const Collision& collision, const Eigen::Vector3d& p_WC,
                          double quarter_turns) {
    const double yaw = quarter_turns * std::numbers::pi / 2.0;
    const Eigen::Quaterniond expected(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()));
    EXPECT_LT((collision.X_WC.translation - p_WC).norm(), 1e-9)
        << collision.name << " is at " << collision.X_WC.translation.transpose();
    EXPECT_LT(collision.X_WC.rotation.angularDistance(expected), 1e-9) << collision.name;
  }
};

const char* const kQuarter = "1.5707963267948966";

TEST_F(LoadWorldPoses, ComposeFromModelToLinkToCollision) {
  const Scene scene = load("<model name='m'><pose>10 0 0 0 0 " + std::string(kQuarter) +
                           "</pose><link name='l'><pose>1 0 0.5 0 0 " + kQuarter + "</pose>" +
                           ball("c", "<pose>2 0 0 0 0 0</pose>") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  // The model rotates (1, 0) to (0, 1); link and model together rotate (2, 0) to (-2, 0).
  expect_pose(scene.collisions[0], {8.0, 1.0, 0.5}, 2.0);
}

TEST_F(LoadWorldPoses, RollPitchYawTurnAboutFixedAxes) {
  const Scene scene =
      load("<model name='m'><pose>0 0 0 " + std::string(kQuarter) + " 0 " + kQuarter +
           "</pose><link name='l'>" + ball("c", "<pose>0 1 0 0 0 0</pose>") + "</link></model>");
  // Roll first: it moves y to z; yaw then leaves z unchanged.
  EXPECT_LT((scene.collisions.at(0).X_WC.translation - Eigen::Vector3d(0, 0, 1)).norm(), 1e-9);
}

TEST_F(LoadWorldPoses, NestedModelsFramesAndRelativeTo) {
  const Scene scene =
      load("<frame name='dock'><pose>5 5 0 0 0 " + std::string(kQuarter) +
           "</pose></frame><model name='outer'><pose relative_to='dock'>1 0 0 0 0 0</pose>"
           "<frame name='top'><pose>0 0 2 0 0 0</pose></frame>"
           "<frame name='arm' attached_to='top'><pose>0 1 0 0 0 " +
           kQuarter +
           "</pose></frame>"
           "<link name='l'><pose relative_to='arm'>1 0 0 0 0 0</pose>" +
           ball("a", "") + ball("b", "<pose relative_to='top'>0 0 1 0 0 0</pose>") +
           "</link><model name='inner'><pose relative_to='top'>3 0 0 0 0 0</pose><link name='k'>"
           "<pose>0 0 1 0 0 0</pose>" +
           ball("c", "") + "</link></model></model>");
  EXPECT_EQ(scene.models, (std::vector<std::string>{"outer", "outer::inner"}));
  ASSERT_EQ(scene.collisions.size(), 3U);
  // outer is at dock (5, 5), rotated by 90°, plus (1, 0) rotated to (0, 1): (5, 6). arm is at (0,
  // 1, 2) in outer: (4, 6, 2), rotated by 180°; (1, 0) is (-1, 0) there.
  EXPECT_EQ(scene.collisions[0].name, "outer::l::a");
  expect_pose(scene.collisions[0], {3.0, 6.0, 2.0}, 2.0);
  // b is 1 m above top, which is 2 m above outer.
  expect_pose(scene.collisions[1], {5.0, 6.0, 3.0}, 1.0);
  // inner is at (3, 0, 2) in outer, its link 1 m above.
  EXPECT_EQ(scene.collisions[2].name, "outer::inner::k::c");
  expect_pose(scene.collisions[2], {5.0, 9.0, 3.0}, 1.0);
}

TEST_F(LoadWorldPoses, PlacementFramePutsThatFrameWhereThePoseSays) {
  const Scene scene = load(
      "<model name='m' placement_frame='foot'><pose>4 0 0 0 0 0</pose>"
      "<frame name='foot'><pose>0 0 -1 0 0 0</pose></frame><link name='l'>" +
      ball("c", "") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  expect_pose(scene.collisions[0], {4.0, 0.0, 1.0}, 0.0);
}

TEST_F(LoadWorldPoses, PlacementFrameOfAnIncludeMayLieInANestedModel) {
  write_model("post",
              "<link name='l'><collision name='c'><geometry><sphere><radius>1</radius>"
              "</sphere></geometry></collision></link><model name='foot'><pose>0 0 -2 0 0 0"
              "</pose><frame name='sole'><pose>0 0 -0.5 0 0 0</pose></frame>"
              "<link name='l'/></model>");
  const Scene scene = load(
      "<frame name='dock'><pose>5 0 0 0 0 0</pose></frame><include><uri>model://post</uri>"
      "<pose relative_to='dock'>0 7 0 0 0 0</pose>"
      "<placement_frame>foot::sole</placement_frame></include>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  expect_pose(scene.collisions[0], {5.0, 7.0, 2.5}, 0.0);
}

TEST_F(LoadWorldPoses, FramesOnJointsStandAtTheirChildLinks) {
  const Scene scene = load(
      "<model name='m'><link name='base'/><link name='arm'><pose>1 0 0 0 0 0</pose></link>"
      "<joint name='j' type='fixed'><pose>0 1 0 0 0 0</pose><parent>base</parent><child>arm</child>"
      "</joint><frame name='f' attached_to='j'/><link name='hand'><pose relative_to='f'>0 0 1 0 0 0"
      "</pose>" +
      ball("c", "") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  expect_pose(scene.collisions[0], {1.0, 1.0, 1.0}, 0.0);
}

TEST_F(LoadWorldPoses, WhatIsMergedStandsWhereItsModelWould) {
  write_model("inner",
              "<frame name='f'><pose>0 1 0 0 0 0</pose></frame><link name='a'>"
              "<pose relative_to='f'>1 0 0 0 0 0</pose>" +
                  ball("c", "") + ball("d", "<pose relative_to='__model__'>0 0 1 0 0 0</pose>") +
                  "</link>");
  write_model("middle",
              "<include merge='true'><uri>model://inner</uri><pose>10 0 0 0 0 0</pose>"
              "</include><link name='b'><pose relative_to='a'>0 0 5 0 0 0</pose>" +
                  ball("c", "") + "</link>");
  const Scene scene = load(
      "<model name='m'><pose>100 0 0 0 0 0</pose><include merge='true'><uri>model://middle</uri>"
      "<pose>0 0 0 0 0 " +
      std::string(kQuarter) + "</pose></include></model>");
  ASSERT_EQ(scene.collisions.size(), 3U);
  EXPECT_EQ(scene.models, std::vector<std::string>{"m"});
  std::map<std::string, Collision> found;
  for (const Collision& collision : scene.collisions) found[collision.name] = collision;
  // (10 + 1, 1) rotated by 90° is (-1, 11).
  expect_pose(found.at("m::a::c"), {99.0, 11.0, 0.0}, 1.0);
  expect_pose(found.at("m::a::d"), {100.0, 10.0, 1.0}, 1.0);
  expect_pose(found.at("m::b::c"), {99.0, 11.0, 5.0}, 1.0);
  EXPECT_TRUE(warnings().empty());
}

/// As Gazebo 11 handles these two.
TEST_F(LoadWorldPoses, RelativeToAFrameThatIsNotThereIsAWarning) {
  const Scene scene = load(
      "<model name='m'>\n<pose relative_to='nope'>1 2 3 0 0 0</pose>"
      "<link name='l'>\n<pose relative_to='nix'>0 0 1 0 0 0</pose>" +
      ball("c", "<pose relative_to='nada'>0 1 0 0 0 0</pose>") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  expect_pose(scene.collisions[0], {1.0, 3.0, 4.0}, 0.0);
  ASSERT_EQ(warnings().size(), 3U);
  EXPECT_NE(warnings()[0].find("world.sdf:4: there is no frame 'nope' here that <model> 'm'"),
            std::string::npos)
      << warnings()[0];
}

/// As Gazebo 11 reads them.
TEST_F(LoadWorldPoses, NumbersMissingAtItsEndAreZero) {
  const Scene scene =
      load("<model name='m'>\n<pose>1 2 3 0 0</pose><link name='l'>\n<pose>0 0 1</pose>" +
           ball("c", "<pose>0\n1</pose>") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  expect_pose(scene.collisions[0], {1.0, 3.0, 4.0}, 0.0);
  ASSERT_EQ(warnings().size(), 3U);
  EXPECT_NE(warnings()[0].find("world.sdf:5: of 6 numbers in <pose> only the first 3 are there"),
            std::string::npos)
      << warnings()[0];
}

/// As Gazebo 11 places them, which looks up poses by name.
TEST_F(LoadWorldPoses, LinksAndCollisionsOfTheSameNameStandWhereTheFirstDoes) {
  const Scene scene =
      load("<model name='m'><link name='l'>\n<pose>1 0 0 0 0 0</pose>" +
           ball("c", "<pose>0 1 0 0 0 0</pose>") + "\n" + ball("c", "<pose>0 2 0 0 0 0</pose>") +
           "</link>\n<link name='l'><pose>2 0 0 0 0 0</pose>" +
           ball("c", "<pose>0 3 0 0 0 0</pose>") + ball("d", "") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 4U);
  for (const std::size_t i : {0U, 1U, 2U}) expect_pose(scene.collisions[i], {1.0, 1.0, 0.0}, 0.0);
  expect_pose(scene.collisions[3], {1.0, 0.0, 0.0}, 0.0);
  ASSERT_EQ(warnings().size(), 3U);
  EXPECT_NE(warnings()[0].find("world.sdf:6: <link> 'l' has the name of the <link> in line 3 and "
                               "gets its pose, as in Gazebo 11"),
            std::string::npos)
      << warnings()[0];
  EXPECT_NE(warnings()[1].find("world.sdf:5: a second collision 'm::l::c' gets"), std::string::npos)
      << warnings()[1];
}

/// Gazebo 11 doesn't merge.
TEST_F(LoadWorldPoses, MergedLinksOfTheSameNameKeepTheirCollisions) {
  for (const std::string name : {"one", "two"}) {
    const std::string y = name == "one" ? "1" : "2";
    write_model(name,
                "<link name='l'>" + ball("c", "<pose>0 " + y + " 0 0 0 0</pose>") + "</link>");
  }
  const std::string include = "<include merge='true'><uri>model://";
  const Scene scene = load("<model name='m'>" + include + "one</uri></include>" + include +
                           "two</uri><pose>5 0 0 0 0 0</pose></include></model>");
  ASSERT_EQ(scene.collisions.size(), 2U);
  expect_pose(scene.collisions[0], {0.0, 1.0, 0.0}, 0.0);
  expect_pose(scene.collisions[1], {5.0, 2.0, 0.0}, 0.0);
}

TEST_F(LoadWorldPoses, IncludesOfTheSameNameStandWhereTheFirstDoesAndNestedModelsDoNot) {
  write_model("post", "<pose>0 0 9 0 0 0</pose><link name='l'>" + ball("c", "") + "</link>");
  const std::string include = "<include><uri>model://post</uri>";
  const auto nested = [&](const std::string& x) {
    return "<model name='n'><pose>" + x + " 0 0 0 0 0</pose><link name='l'>" + ball("c", "") +
           "</link></model>";
  };
  const Scene scene = load(
      "<model name='m'><link name='base'/>" + include + "<pose>0 1 0 0 0 0</pose></include>\n" +
      include + "<pose>0 2 0 0 0 0</pose></include>" + nested("3") + nested("4") + "</model>");
  ASSERT_EQ(scene.collisions.size(), 4U);
  expect_pose(scene.collisions[0], {0.0, 1.0, 0.0}, 0.0);
  expect_pose(scene.collisions[1], {0.0, 1.0, 0.0}, 0.0);
  expect_pose(scene.collisions[2], {3.0, 0.0, 0.0}, 0.0);
  expect_pose(scene.collisions[3], {4.0, 0.0, 0.0}, 0.0);
  ASSERT_EQ(warnings().size(), 2U);
  EXPECT_NE(warnings()[0].find("world.sdf:4: <include> 'post' has the name of the <include> in "
                               "line 3 and gets its pose"),
            std::string::npos)
      << warnings()[0];
}

TEST_F(LoadWorldPoses, FramesInACircleAreNowhere) {
  load(
      "<model name='m'><frame name='f' attached_to='g'/><frame name='g' attached_to='f'/>"
      "<link name='l'><pose relative_to='f'/>" +
      ball("c", "") + "</link></model>");
  EXPECT_EQ(warnings().size(), 1U);
}

TEST_F(LoadWorldPoses, FramesInCirclesOverModelsComeToAnEnd) {
  // A cycle in each of three models; each step of an outer one goes through the whole inner cycle.
  const Scene scene = load(
      "<model name='m'><frame name='f' attached_to='n::g'/>"
      "<model name='n'><pose relative_to='n::g'/><frame name='g' attached_to='k::h'/>"
      "<model name='k'><pose relative_to='k::h'/><frame name='h' attached_to='h'/></model></model>"
      "<link name='l'><pose relative_to='f'/>" +
      ball("c", "") + "</link></model>");
  EXPECT_EQ(scene.collisions.size(), 1U);
  EXPECT_FALSE(warnings().empty());
}

TEST_F(LoadWorldPoses, LongChainsOfFramesAreFollowed) {
  std::string frames;
  for (int i = 1; i < 1000; ++i) {
    frames += "<frame name='f" + std::to_string(i) + "' attached_to='f" + std::to_string(i - 1) +
              "'><pose>0.001 0 0 0 0 0</pose></frame>";
  }
  const Scene scene =
      load("<model name='m'><frame name='f0'/>" + frames +
           "<link name='l'><pose relative_to='f999'/>" + ball("c", "") + "</link></model>");
  expect_pose(scene.collisions.at(0), {0.999, 0.0, 0.0}, 0.0);
}

TEST_F(LoadWorldPoses, DegreesAndQuaternions) {
  const Scene scene = load(
      "<model name='m'><pose degrees='true'>1 0 0 0 0 90</pose><link name='l'>"
      "<pose rotation_format='quat_xyzw'>1 0 0  0 0 0.70710678118654757 "
      "0.70710678118654757</pose>" +
      ball("c", "") + "</link></model>");
  expect_pose(scene.collisions.at(0), {1.0, 1.0, 0.0}, 2.0);
}

TEST_F(LoadWorldPoses, TheOldNameOfRelativeTo) {
  const Scene scene = load(
      "<model name='m'><link name='a'><pose frame=''>0 0 1 0 0 0</pose></link>"
      "<link name='b'><pose frame='a'>0 0 1 0 0 0</pose>" +
          ball("c", "") + "</link></model>",
      "1.6");
  expect_pose(scene.collisions.at(0), {0.0, 0.0, 2.0}, 0.0);
}

/// Positions that the real Gazebo 11.1 gives these copies (`gz model -m a_clone_0 -p`, …).
TEST_F(LoadWorldPoses, PopulationsStandAsInGazebo) {
  const auto population = [](const std::string& name, const std::string& pose,
                             const std::string& distribution) {
    return "<population name='p'><model name='" + name + "'><pose>0.1 0.2 0.3 0 0 0.5</pose>" +
           "<link name='l'>" + ball("c", "<pose>0 0 1 0 0 0</pose>") + "</link></model><pose>" +
           pose + "</pose><box><size>4 2 1</size></box>" + distribution + "</population>";
  };
  const Scene scene = load(
      population("x", "10 20 0.5 0 0 0.3",
                 "<model_count>4</model_count><distribution><type>linear-x</type></distribution>") +
      population("y", "30 20 0 0 0.2 0",
                 "<model_count>3</model_count><distribution><type>linear-y</type></distribution>") +
      population("z", "50 20 0 0 0 0",
                 "<model_count>3</model_count><distribution><type>linear-z</type></distribution>") +
      population("grid", "70 20 1 0 0 0.3",
                 "<model_count>3</model_count><distribution><type>grid</type><rows>2</rows>"
                 "<cols>3</cols><step>0.5 0.25 0.1</step></distribution>"));
  const std::map<std::string, Eigen::Vector3d> expected = {
      {"x_clone_0", {7.70448, 19.9553, 0.5}},       {"x_clone_1", {8.65982, 20.2509, 0.5}},
      {"x_clone_3", {10.5705, 20.8419, 0.5}},       {"y_clone_0", {30.0595, 19.0, -0.407305}},
      {"y_clone_1", {30.0595, 19.6667, -0.407305}}, {"z_clone_0", {50.0, 20.0, -0.5}},
      {"z_clone_1", {50.0, 20.0, -0.166667}},       {"grid_clone_0", {69.5, 19.875, 1.0}},
      {"grid_clone_1", {69.9777, 20.0228, 1.0}},    {"grid_clone_2", {70.4553, 20.1705, 1.0}},
      {"grid_clone_3", {69.4261, 20.1138, 1.0}},    {"grid_clone_5", {70.3815, 20.4094, 1.0}}};
  EXPECT_EQ(scene.models.size(), 4U + 3U + 3U + 6U);
  std::size_t found = 0;
  for (const Collision& collision : scene.collisions) {
    const auto known = expected.find(collision.name.substr(0, collision.name.find(':')));
    if (known == expected.end()) continue;
    ++found;
    const Eigen::Vector3d p_WC = known->second + Eigen::Vector3d::UnitZ();
    EXPECT_LT((collision.X_WC.translation - p_WC).norm(), 1e-4) << collision.name;
    EXPECT_LT(collision.X_WC.rotation.angularDistance(Eigen::Quaterniond::Identity()), 1e-9);
  }
  EXPECT_EQ(found, expected.size());
  EXPECT_TRUE(diagnostics_.warnings().empty());
}

TEST_F(LoadWorldPoses, PopulationsThatGazeboDoesNotPlaceAreLeftOut) {
  const auto population = [](const std::string& name, const std::string& rest) {
    return "<population name='" + name + "'><model name='m'><link name='l'>" + ball("c", "") +
           "</link></model>" + rest + "</population>\n";
  };
  const std::string pose = "<pose>0 0 0 0 0 0</pose>";
  const Scene scene =
      load(population("a", pose + "<box/><distribution><type>random</type></distribution>") +
           population("b", pose + "<distribution><type>linear-x</type></distribution>") +
           population("c", pose + "<distribution><type>grid</type><rows>1</rows></distribution>") +
           population("d", "<box/><distribution><type>linear-x</type></distribution>") +
           population("e", pose + "<box/><distribution><type>round</type></distribution>") +
           population("f", pose + "<box/><model_count>-5</model_count><distribution>"
                                  "<type>linear-x</type></distribution>") +
           "<population name='g'>" + pose + "<box/></population>");
  EXPECT_TRUE(scene.collisions.empty());
  const std::vector<std::string> expected = {
      ":3: <population> 'a' is left out: Gazebo draws the positions at random, others in each run",
      ":4: <population> 'b' is left out: it lacks <box>",
      ":5: <population> 'c' is left out: its <distribution> lacks <cols>",
      ":6: <population> 'd' is left out: it lacks <pose>",
      ":7: <population> 'e' is left out: its distribution is 'round' (expected grid, linear-x, "
      "linear-y or linear-z)",
      ":8: <population> 'f' is left out: it asks for less than one copy",
      ":9: <population> 'g' is left out: it lacks <model>"};
  ASSERT_EQ(diagnostics_.warnings().size(), expected.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_NE(diagnostics_.warnings()[i].find(expected[i]), std::string::npos)
        << diagnostics_.warnings()[i];
  }
  EXPECT_EQ(error_of(population("f", pose + "<box/><model_count>100001</model_count><distribution>"
                                            "<type>linear-x</type></distribution>")),
            "world.sdf:3: <model_count> of over 100000");
  EXPECT_EQ(error_of(population("g", pose + "<distribution><type>grid</type><rows>1000</rows><cols>"
                                            "1000</cols><step>1 1 0</step></distribution>")),
            "world.sdf:3: a grid of over 100000 models");
}

TEST_F(LoadWorldPoses, AModelCalledWorldStandsAsWritten) {
  const Scene scene =
      load("<model name='world'><pose>1 2 3 0 0 0</pose><link name='l'>" +
           ball("c", "<pose>0 0 1 0 0 0</pose>") +
           "</link></model><model name='m'><pose>5 0 0 0 0 0</pose><link name='l'>" +
           ball("c", "") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 2U);
  expect_pose(scene.collisions[0], {1.0, 2.0, 4.0}, 0.0);
  expect_pose(scene.collisions[1], {5.0, 0.0, 0.0}, 0.0);
}

}  // namespace
}  // namespace tagfield
