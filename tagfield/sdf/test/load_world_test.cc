// SPDX-License-Identifier: Apache-2.0
#include "tagfield/sdf/load_world.h"

#include <Eigen/Geometry>
#include <filesystem>

#include "tagfield/sdf/test/world_test.h"

namespace tagfield {
namespace {

class LoadWorld : public WorldTest {
 protected:
  template <typename T>
  T only_shape(const std::string& geometry) {
    const Scene scene = load(model_with(geometry));
    EXPECT_EQ(scene.collisions.size(), 1U);
    EXPECT_TRUE(warnings().empty());
    return std::get<T>(scene.collisions.at(0).shape);
  }
};

TEST_F(LoadWorld, ReadsABox) {
  EXPECT_EQ(only_shape<Box>("<box><size>1 2 3</size></box>").size, Eigen::Vector3d(1, 2, 3));
}

TEST_F(LoadWorld, ReadsACylinder) {
  const auto cylinder =
      only_shape<Cylinder>("<cylinder><radius>0.5</radius><length>2</length></cylinder>");
  EXPECT_EQ(cylinder.radius, 0.5);
  EXPECT_EQ(cylinder.length, 2.0);
}

TEST_F(LoadWorld, ReadsASphere) {
  EXPECT_EQ(only_shape<Sphere>("<sphere><radius>0.25</radius></sphere>").radius, 0.25);
}

TEST_F(LoadWorld, ReadsAPlaneAndNormalizesItsNormal) {
  const auto plane = only_shape<Plane>("<plane><normal>0 3 4</normal><size>5 6</size></plane>");
  EXPECT_LT((plane.normal - Eigen::Vector3d(0.0, 0.6, 0.8)).norm(), 1e-12);
  EXPECT_EQ(plane.size, Eigen::Vector2d(5.0, 6.0));
}

TEST_F(LoadWorld, ReadsAMeshBesideTheFileThatNamesIt) {
  write("meshes/triangle.obj", kTriangleObj);
  const auto mesh =
      only_shape<MeshPtr>("<mesh><uri>meshes/triangle.obj</uri><scale>2 3 1</scale></mesh>");
  ASSERT_EQ(mesh->triangles.size(), 1U);
  EXPECT_EQ(mesh->vertices[1], Eigen::Vector3d(2, 0, 0));
  EXPECT_EQ(mesh->vertices[2], Eigen::Vector3d(0, 3, 0));
}

TEST_F(LoadWorld, MeshesOfOneFileAreShared) {
  write("t.obj", kTriangleObj);
  const auto collision = [](const std::string& name, const std::string& scale) {
    return "<collision name='" + name + "'><geometry><mesh><uri>t.obj</uri><scale>" + scale +
           "</scale></mesh></geometry></collision>";
  };
  const Scene scene = load("<model name='m'><link name='l'>" + collision("a", "1 1 1") +
                           collision("b", "1 1 1") + collision("c", "2 1 1") + "</link></model>");
  ASSERT_EQ(scene.collisions.size(), 3U);
  const auto mesh = [&scene](std::size_t i) {
    return std::get<MeshPtr>(scene.collisions[i].shape);
  };
  EXPECT_EQ(mesh(0), mesh(1));
  EXPECT_NE(mesh(0), mesh(2));
}

TEST_F(LoadWorld, IncludesModelsFromSearchPathsUnderTheirNewName) {
  write("library/crate/model.config",
        "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("library/crate/model.sdf",
        "<sdf version='1.6'><model name='crate'><link name='l'><collision name='c'><geometry>"
        "<mesh><uri>model://crate/meshes/t.obj</uri></mesh></geometry></collision></link></model>"
        "</sdf>");
  write("library/crate/meshes/t.obj", kTriangleObj);
  const std::string path =
      write("world.sdf", world("<include><uri>model://crate</uri><name>red</name>"
                               "<pose>1 2 3 0 0 0</pose></include><include><uri>model://crate</uri>"
                               "</include>"));
  const Scene scene = load_file(path, {path_of("library")});
  EXPECT_EQ(scene.models, (std::vector<std::string>{"red", "crate"}));
  ASSERT_EQ(scene.collisions.size(), 2U);
  EXPECT_EQ(scene.collisions[0].name, "red::l::c");
  EXPECT_EQ(scene.collisions[0].X_WC.translation, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(std::get<MeshPtr>(scene.collisions[0].shape),
            std::get<MeshPtr>(scene.collisions[1].shape));
  EXPECT_TRUE(warnings().empty());
}

TEST_F(LoadWorld, SearchPathsComeBeforeTheCurrentFolder) {
  for (const std::string& folder : std::vector<std::string>{"library", "current"}) {
    write(folder + "/crate/model.config",
          "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
    write(folder + "/crate/model.sdf",
          "<sdf version='1.6'><model name='from_" + folder + "'><link name='l'/></model></sdf>");
  }
  const std::string path = write("w.sdf", world("<include><uri>model://crate</uri></include>"));
  const std::filesystem::path before = std::filesystem::current_path();
  std::filesystem::current_path(path_of("current"));
  const Scene scene = load_file(path, {path_of("library")});
  std::filesystem::current_path(before);
  EXPECT_EQ(scene.models, std::vector<std::string>{"from_library"});
}

constexpr const char* kBoxAndTag =
    "<static>1</static><link name='l'><collision name='c'><geometry><box><size>1 1 1</size></box>"
    "</geometry></collision><sensor name='t' type='rfidtag'/></link>";

TEST_F(LoadWorld, IncludesWithinIncludedModels) {
  write_model("crate", kBoxAndTag);
  write_model("pallet", std::string(kBoxAndTag) +
                            "<include><uri>model://crate</uri><pose>1 0 0 0 0 0</pose></include>");
  write_model("rack",
              "<include><uri>model://pallet</uri><pose>0 10 0 0 0 1.5707963267948966</pose>"
              "</include><include><name>top</name><uri>model://pallet</uri></include>");
  const Scene scene =
      load("<include><uri>model://rack</uri><pose>100 0 0 0 0 0</pose></include>", "1.6");
  std::map<std::string, Eigen::Vector3d> places;
  for (const Collision& collision : scene.collisions) {
    places[collision.name] = collision.X_WC.translation;
  }
  ASSERT_EQ(places.size(), 4U);
  EXPECT_EQ(scene.tags.size(), 4U);
  EXPECT_TRUE(places.at("rack::pallet::l::c").isApprox(Eigen::Vector3d(100, 10, 0)));
  EXPECT_TRUE(places.at("rack::pallet::crate::l::c").isApprox(Eigen::Vector3d(100, 11, 0)));
  EXPECT_TRUE(places.at("rack::top::l::c").isApprox(Eigen::Vector3d(100, 0, 0)));
  EXPECT_TRUE(places.at("rack::top::crate::l::c").isApprox(Eigen::Vector3d(101, 0, 0)));
}

TEST_F(LoadWorld, RelativeIncludeIsBesideTheFileThatAsks) {
  write_model("shelf", "<include><uri>part.sdf</uri></include>");
  write("models/shelf/part.sdf",
        "<sdf version='1.6'><model name='part'>" + std::string(kBoxAndTag) + "</model></sdf>");
  EXPECT_EQ(load("<include><uri>\n model://shelf </uri></include>").collisions.size(), 1U);
}

TEST_F(LoadWorld, MergedIncludesAndThoseOfWhatIsMerged) {
  write_model("crate", kBoxAndTag);
  write_model("pallet", std::string(kBoxAndTag) + "<include><uri>model://crate</uri></include>");
  const Scene scene = load(
      "<model name='m'><include merge='true'><uri>model://pallet</uri></include></model>", "1.9");
  EXPECT_EQ(scene.collisions.size(), 2U);
}

TEST_F(LoadWorld, IncludesOfLightsAreNoModels) {
  write("lamp.sdf", "<sdf version='1.6'><light type='point' name='lamp'/></sdf>");
  EXPECT_TRUE(load("<include><uri>lamp.sdf</uri></include>").models.empty());
}

TEST_F(LoadWorld, RelativeMeshOfAnIncludedModelIsBesideThatModel) {
  write("models/crate/model.config",
        "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("models/crate/model.sdf",
        "<sdf version='1.6'>" + model_with("<mesh><uri>meshes/t.obj</uri></mesh>") + "</sdf>");
  write("models/crate/meshes/t.obj", kTriangleObj);
  EXPECT_EQ(load("<include><uri>model://crate</uri></include>").collisions.size(), 1U);
}

TEST_F(LoadWorld, TakesAFileOfOneModelForAScene) {
  const std::string path = write("model.sdf",
                                 "<sdf version='1.6'><model name='crate'>"
                                 "<pose>1 2 3 0 0 0</pose><link name='l'>"
                                 "<collision name='c'><geometry><sphere><radius>1"
                                 "</radius></sphere></geometry></collision></link>"
                                 "</model></sdf>");
  const Scene scene = load_file(path);
  EXPECT_EQ(scene.name, "crate");
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_EQ(scene.collisions[0].X_WC.translation, Eigen::Vector3d(1, 2, 3));
}

TEST_F(LoadWorld, ShapesThatBecomeMeshes) {
  const auto bounds = [&](const std::string& geometry) {
    Eigen::AlignedBox3d box;
    const auto mesh = only_shape<MeshPtr>(geometry);
    for (const auto& vertex : mesh->vertices) box.extend(vertex);
    return box;
  };
  const auto capsule = bounds("<capsule><radius>0.5</radius><length>2</length></capsule>");
  EXPECT_TRUE(capsule.max().isApprox(Eigen::Vector3d(0.5, 0.5, 1.5)));
  const auto egg = bounds("<ellipsoid><radii>1 2 3</radii></ellipsoid>");
  EXPECT_TRUE(egg.min().isApprox(Eigen::Vector3d(-1, -2, -3)));
  const auto cone = bounds("<cone><radius>1</radius><length>4</length></cone>");
  EXPECT_TRUE(cone.sizes().isApprox(Eigen::Vector3d(2, 2, 4)));
  // In Gazebo 11, a ball of 0.4 m comes to rest on this at 1.9 m.
  const auto bar = bounds(
      "<polyline><height>1.5</height><point>0 0</point><point>4 0</point><point>4 4</point>"
      "<point>0 4</point></polyline>");
  EXPECT_EQ(bar.min(), Eigen::Vector3d(0, 0, 0));
  EXPECT_EQ(bar.max(), Eigen::Vector3d(4, 4, 1.5));
}

TEST_F(LoadWorld, ShapesThatEncloseNothingAreLeftOutWithAWarning) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"<box>\n<size>1 0 1</size></box>", "a <box> of 1 0 1 m has no volume"},
      {"<box><size>1 -2 1</size></box>", "a <box> of 1 -2 1 m has no volume"},
      {"<sphere><radius>0</radius></sphere>", "a <sphere> of 0 m has no volume"},
      {"<cylinder><radius>1</radius><length>-1</length></cylinder>", "a <cylinder> of 1 -1 m"},
      {"<plane><normal>0 0 0</normal></plane>", "its <normal> has no direction"},
      {"<plane><size>-1 1</size></plane>", "a <plane> of -1 1 m"},
      {"<mesh/>", "<mesh> without <uri>"},
      {"<mesh><uri>t.obj</uri><scale>1 0 1</scale></mesh>", "its <scale> makes it flat"},
      {"<polyline><height>1</height><point>0 0</point><point>1 0</point></polyline>",
       "its <polyline> encloses nothing"},
      {"<banana/>", "shape <banana> is not known"},
      {"", "it has no geometry"}};
  for (const auto& [geometry, expected] : cases) {
    diagnostics_ = {};
    EXPECT_TRUE(load(model_with(geometry)).collisions.empty()) << geometry;
    ASSERT_EQ(warnings().size(), 1U) << geometry;
    EXPECT_NE(warnings()[0].find("collision 'm::l::c' is left out: " + expected), std::string::npos)
        << warnings()[0];
  }
  diagnostics_ = {};
  EXPECT_TRUE(load(model_with("<empty/>")).collisions.empty());
  EXPECT_TRUE(warnings().empty());
}

/// As in Gazebo 11.
TEST_F(LoadWorld, SizesThatAreLeftOutAreGazebos) {
  const Scene scene = load(model_with("<sphere/>") +
                           "<model name='n'><link name='l'><collision name='c'><geometry><box/>"
                           "</geometry></collision></link></model>");
  ASSERT_EQ(scene.collisions.size(), 2U);
  EXPECT_EQ(std::get<Sphere>(scene.collisions[0].shape).radius, 1.0);
  EXPECT_EQ(std::get<Box>(scene.collisions[1].shape).size, Eigen::Vector3d(1, 1, 1));
  ASSERT_EQ(warnings().size(), 2U);
  EXPECT_NE(warnings()[0].find("world.sdf:6: <sphere> without <radius>: 1 m is assumed"),
            std::string::npos)
      << warnings()[0];
}

TEST_F(LoadWorld, NamesTwiceAreWarningsAndInModelsBothStand) {
  const std::string collision =
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>\n";
  EXPECT_EQ(load("<model name='m'><link name='l'>\n" + collision + collision + "</link></model>")
                .collisions.size(),
            2U);
  EXPECT_EQ(warnings().size(), 1U);
  const std::string part = "<model name='m'><link name='l'/></model>\n";
  EXPECT_EQ(load("<model name='around'><link name='l'/>\n" + part + part + "</model>").models,
            (std::vector<std::string>{"around", "around::m", "around::m"}));
}

TEST_F(LoadWorld, OfTwoModelsOfOneNameTheWorldHasTheFirst) {
  const std::string shape =
      "<link name='l'><collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry>"
      "</collision></link></model>\n";
  const Scene scene = load("<model name='m'><pose>1 0 0 0 0 0</pose>" + shape +
                           "<model name='m'><pose>2 0 0 0 0 0</pose>" + shape);
  EXPECT_EQ(scene.models, std::vector<std::string>{"m"});
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_EQ(scene.collisions[0].X_WC.translation.x(), 1.0);
  EXPECT_NE(warnings().back().find("there is a model 'm' already"), std::string::npos);
}

TEST_F(LoadWorld, RelativeUrisAreOfTheFileThatTheyStandIn) {
  for (const char* name : {"one", "two"}) {
    write_model(name, "<link name='l'/>\n<include><uri>part.sdf</uri></include>");
    write("models/" + std::string(name) + "/part.sdf", "<sdf version='1.6'><model name='part_of_" +
                                                           std::string(name) +
                                                           "'><link name='l'/></model></sdf>");
  }
  const Scene scene =
      load("<include><uri>model://one</uri></include><include><uri>model://two</uri></include>");
  EXPECT_EQ(scene.models,
            (std::vector<std::string>{"one", "one::part_of_one", "two", "two::part_of_two"}));
}

TEST_F(LoadWorld, WorldsSavedWithModelsInModelsMadeFlat) {
  const std::string link =
      "<link name='inner::body'><pose frame=''>0 0 1 0 0 0</pose><collision name='c'>"
      "<pose frame=''>0 2 0 0 0 0</pose><geometry><box><size>1 1 1</size></box></geometry>"
      "</collision></link>";
  const Scene scene = load("<model name='m'><pose frame=''>5 0 0 0 0 0</pose>\n" + link +
                               "<joint name='inner::j' type='fixed'><parent>world</parent>"
                               "<child>inner::body</child></joint></model>",
                           "1.6");
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_TRUE(scene.collisions[0].X_WC.translation.isApprox(Eigen::Vector3d(5, 2, 1)));
  EXPECT_EQ(scene.collisions[0].name, "m::inner::body::c");
  EXPECT_TRUE(warnings().empty());
}

TEST_F(LoadWorld, WhatIsMissingCanBeSkipped) {
  write("broken.obj", "hello\n");
  const std::string path =
      write("world.sdf",
            world("<model name='around'><include><uri>model://nosuch</uri></include></model>\n" +
                  model_with("<mesh>\n<uri>broken.obj</uri></mesh>") +
                  "<model name='n'><link name='l'><collision name='c'><geometry><sphere><radius>1"
                  "</radius></sphere></geometry></collision></link></model>"));
  WorldOptions options;
  options.skip_missing = true;
  const Scene scene = load_world(path, {}, diagnostics_, options);
  EXPECT_EQ(scene.models, (std::vector<std::string>{"around", "m", "n"}));
  EXPECT_EQ(scene.collisions.size(), 1U);
  // One for each, none that the model around it has no links.
  ASSERT_EQ(warnings().size(), 2U);
  EXPECT_EQ(warnings()[0], path + ":3: can't find 'model://nosuch': left out");
  EXPECT_NE(warnings()[1].find("broken.obj"), std::string::npos);
}

/// Gazebo's model, as installed with Gazebo 11, without its looks and friction.
constexpr const char* kGroundPlane =
    "<static>true</static><link name='link'><collision name='collision'><geometry><plane><normal>0 "
    "0 1</normal><size>100 100</size></plane></geometry></collision></link>";

/// Worlds that include them load the same where Gazebo is installed and where it is not.
TEST_F(LoadWorld, GroundPlaneAndSunNeedNoGazebo) {
  const std::string includes =
      "<include><uri>model://sun</uri></include>\n"
      "<include><uri>model://ground_plane</uri></include>\n"
      "<include><uri>https://fuel.gazebosim.org/1.0/OpenRobotics/models/Ground Plane</uri>"
      "<name>deck</name><pose>1 2 3 0 0 0</pose></include>\n";
  const Scene without = load(includes);
  const std::vector<std::string> warned = warnings();
  write_model("ground_plane", kGroundPlane);
  write("models/sun/model.sdf", "<sdf version='1.6'><light type='directional' name='sun'/></sdf>");
  const Scene with = load(includes);

  EXPECT_EQ(without.models, (std::vector<std::string>{"ground_plane", "deck"}));
  EXPECT_EQ(without.models, with.models);
  ASSERT_EQ(without.collisions.size(), with.collisions.size());
  for (std::size_t i = 0; i < with.collisions.size(); ++i) {
    EXPECT_EQ(without.collisions[i].name, with.collisions[i].name);
    EXPECT_EQ(without.collisions[i].X_WC.translation, with.collisions[i].X_WC.translation);
    EXPECT_EQ(std::get<Plane>(without.collisions[i].shape).size,
              std::get<Plane>(with.collisions[i].shape).size);
  }
  if (std::filesystem::exists("/usr/share/gazebo-11/models/ground_plane")) return;
  ASSERT_EQ(warned.size(), 3U);
  EXPECT_EQ(warned[0], path_of("world.sdf") +
                           ":3: can't find 'model://sun': taken as a light, which changes nothing "
                           "here");
  EXPECT_EQ(warned[1], path_of("world.sdf") +
                           ":4: can't find 'model://ground_plane': a plane of 100 m x 100 m at "
                           "z = 0 is used, as in Gazebo's model");
}

TEST_F(LoadWorld, OtherModelsOfTheirNamesAreReadOrMissed) {
  write_model("ground_plane", "<link name='l'/>");
  EXPECT_TRUE(load("<include><uri>model://ground_plane</uri></include>").collisions.empty());
  std::vector<std::string> uris = {"file:///nosuch/sun", "model://nosuch/sun"};
  // Of models on Fuel, those of the same name that Gazebo 11 comes with are read.
  if (!std::filesystem::exists("/usr/share/gazebo-11/models/sun")) {
    uris.emplace_back("https://fuel.gazebosim.org/1.0/nosuch/models/Sun");
  }
  for (const std::string& uri : uris) {
    EXPECT_NE(error_of("<include><uri>" + uri + "</uri></include>").find("can't find"),
              std::string::npos)
        << uri;
  }
  const std::string path =
      write("a/deep/world.sdf",
            world("<include><uri>file://" + path_of("models/ground_plane") + "</uri></include>"));
  EXPECT_NE(error_of_file(path).find("lies outside"), std::string::npos);
}

TEST_F(LoadWorld, IncludesOfNothingAreLeftOutWithAWarning) {
  EXPECT_TRUE(load("\n<include><name>x</name></include>").models.empty());
  EXPECT_EQ(warnings(), std::vector<std::string>{path_of("world.sdf") +
                                                 ":4: <include> without <uri>: left out"});
}

/// As in three of Gazebo's own models, which Gazebo 11 accepts.
TEST_F(LoadWorld, AttributesNeedNoQuotes) {
  const Scene scene = load(
      "<!-- name=x '> --><model name = m><link name='l = 1'><collision name=c><geometry><sphere>"
      "<radius>1</radius></sphere></geometry></collision><visual name=v/></link></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_EQ(scene.collisions[0].name, "m::l = 1::c");
}

TEST_F(LoadWorld, FilesWithoutAVersionAreReadWithAWarning) {
  const std::string path = write("w.sdf", "<sdf><world name='w'/></sdf>");
  EXPECT_EQ(load_file(path).name, "w");
  EXPECT_EQ(warnings(),
            std::vector<std::string>{path + ":1: <sdf> without a version: read as the newest"});
}

TEST_F(LoadWorld, ANewerModelFileIsTakenWhereThereAreSeveral) {
  write("models/crate/model.config",
        "<model><sdf version='1.4'>old.sdf</sdf><sdf version='1.10'>new.sdf</sdf>"
        "<sdf version='1.5'>middle.sdf</sdf></model>");
  for (const std::string& name : std::vector<std::string>{"old", "new", "middle"}) {
    write("models/crate/" + name + ".sdf",
          "<sdf version='1.4'><model name='" + name + "'><link name='l'/></model></sdf>");
  }
  EXPECT_EQ(load("<include><uri>model://crate</uri></include>").models,
            std::vector<std::string>{"new"});
}

TEST_F(LoadWorld, NamesTheMaterialsOnceAndSorted) {
  write("t.obj", std::string("mtllib t.mtl\nusemtl Steel\n") + kTriangleObj);
  write("t.mtl", "newmtl Steel\nKd 1 1 1\n");
  const auto visual = [](const std::string& name, const std::string& material) {
    return "<visual name='" + name + "'><geometry><mesh><uri>t.obj</uri></mesh></geometry>" +
           material + "</visual>";
  };
  const auto script = [](const std::string& name) {
    return "<material><script><uri>file://x</uri><name>" + name + "</name></script></material>";
  };
  const Scene scene = load("<model name='m'><link name='l'>" + visual("a", script("Gazebo/Wood")) +
                           visual("b", script("Gazebo/Blue")) + visual("c", script("Gazebo/Wood")) +
                           visual("d", "<material><diffuse>1 0.5 0 1</diffuse></material>") +
                           visual("e", "") + "</link></model>");
  EXPECT_EQ(scene.materials, (std::vector<std::string>{"Gazebo/Blue", "Gazebo/Wood", "Steel",
                                                       "rgba(1, 0.5, 0, 1)"}));
  EXPECT_TRUE(warnings().empty());
}

TEST_F(LoadWorld, VisualMeshThatIsMissingIsOnlyAWarning) {
  const Scene scene = load(
      "<model name='m'><link name='l'>\n<visual name='v'><geometry><mesh><uri>nosuch.dae</uri>"
      "</mesh></geometry></visual></link></model>");
  EXPECT_TRUE(scene.materials.empty());
  ASSERT_EQ(warnings().size(), 1U);
  EXPECT_NE(warnings()[0].find("world.sdf:4: visual 'v'"), std::string::npos) << warnings()[0];
}

TEST_F(LoadWorld, UnknownElementsAreWarningsAndWhatIsNotUsedIsNotLookedAt) {
  const Scene scene = load(
      "<banana/>\n<model name='m'><pose>1 0 0 0 0 0</pose><link name='l'><inertial><inertia><ixx>x"
      "</ixx></inertia></inertial><collision name='c'><surface><friction><ode><mu>1 2</mu></ode>"
      "</friction></surface><geometry><sphere><radius>1</radius></sphere></geometry></collision>"
      "</link><joint name='j' type='fixed'><parent>l</parent><child>nope</child></joint>"
      "<gz:thing/></model>");
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_EQ(scene.collisions[0].X_WC.translation, Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(warnings(), std::vector<std::string>{path_of("world.sdf") +
                                                 ":3: <banana> in <world> is not SDF (ignored)"});
}

TEST_F(LoadWorld, ModelWithoutLinksIsAWarning) {
  const Scene scene = load("<model name='empty'><pose>1 2 3 0 0 0</pose></model>\n" +
                           model_with("<sphere><radius>1</radius></sphere>"));
  EXPECT_EQ(scene.models, (std::vector<std::string>{"empty", "m"}));
  EXPECT_EQ(scene.collisions.size(), 1U);
  EXPECT_EQ(warnings().size(), 1U);
}

/// A model at (1, 0, 0) with its link 1 m above it and its ball 0.1 m in front of that.
std::string ball_called(const std::string& name) {
  return "<model name='" + name +
         "'><pose>1 0 0 0 0 0</pose><link name='l'><pose>0 0 1 0 0 0</pose><collision name='c'>"
         "<pose>0.1 0 0 0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry>"
         "</collision></link></model>";
}

TEST_F(LoadWorld, SavedStateSaysWhereModelsStand) {
  const Scene scene = load(
      "<state world_name='test'>"
      "<model name='turned'><pose>5 6 0 0 0 1.5707963267948966</pose></model>"
      // The link moved within its model; Gazebo reports its pose in the world frame.
      "<model name='bent'><pose>9 9 9 0 0 0</pose><link name='l'>"
      "<pose>2 3 4 0 0 0</pose></link></model></state>" +
          ball_called("turned") + ball_called("bent") + ball_called("as_written"),
      "1.6");
  ASSERT_EQ(scene.collisions.size(), 3U);
  EXPECT_TRUE(scene.collisions[0].X_WC.translation.isApprox(Eigen::Vector3d(5, 6.1, 1)));
  EXPECT_TRUE(scene.collisions[1].X_WC.translation.isApprox(Eigen::Vector3d(2.1, 3, 4)));
  EXPECT_TRUE(scene.collisions[2].X_WC.translation.isApprox(Eigen::Vector3d(1.1, 0, 1)));
  EXPECT_TRUE(warnings().empty());
}

TEST_F(LoadWorld, SavedStateOfNestedModelsAndOfDeletedOnes) {
  const Scene scene = load(
      "<state world_name='test'><deletions><name>gone</name></deletions>"
      "<model name='outer'><pose>1 2 3 0 0 0</pose><model name='inner'><pose>7 8 9 0 0 0</pose>"
      "</model></model></state>"
      "<model name='outer'>" +
          ball_called("inner") + "</model>" + ball_called("gone"),
      "1.6");
  EXPECT_EQ(scene.models, (std::vector<std::string>{"outer", "outer::inner"}));
  ASSERT_EQ(scene.collisions.size(), 1U);
  EXPECT_TRUE(scene.collisions[0].X_WC.translation.isApprox(Eigen::Vector3d(7.1, 8, 10)));
}

/// As in Gazebo 11.
TEST_F(LoadWorld, ModelsThatCameWhileASavedWorldRan) {
  const Scene scene = load("<state world_name='test'>\n<insertions>" + ball_called("new") +
                               "</insertions></state>" + ball_called("m"),
                           "1.6");
  EXPECT_EQ(scene.models, (std::vector<std::string>{"m", "new"}));
  EXPECT_TRUE(scene.collisions.at(1).X_WC.translation.isApprox(Eigen::Vector3d(1.1, 0, 1)));
}

TEST_F(LoadWorld, WhatOfASavedStateIsNotUsedIsReported) {
  load(
      "<state world_name='test'>\n<model name='m'><pose>0 0 0 0 0 0</pose><scale>2 1 1</scale>"
      "</model></state>" +
          ball_called("m"),
      "1.6");
  ASSERT_EQ(warnings().size(), 1U);
  EXPECT_NE(warnings()[0].find("world.sdf:4: <scale> in <state>"), std::string::npos);
}

TEST_F(LoadWorld, PrintsNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  load("<banana/>" + model_with("<banana/>"));
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

}  // namespace
}  // namespace tagfield
