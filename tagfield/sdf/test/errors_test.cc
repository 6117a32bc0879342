// SPDX-License-Identifier: Apache-2.0
#include <utility>

#include "tagfield/sdf/test/world_test.h"

namespace tagfield {
namespace {

/// Each error starts with its file and line.
class LoadWorldErrors : public WorldTest {
 protected:
  void expect_error(const std::string& inside, const std::string& start,
                    const std::string& part = "") {
    const std::string error = error_of(inside);
    EXPECT_EQ(error.rfind(start, 0), 0U) << "for " << inside << "\ngot: " << error;
    EXPECT_NE(error.find(part), std::string::npos) << "for " << inside << "\ngot: " << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
};

TEST_F(LoadWorldErrors, MissingFile) {
  EXPECT_EQ(error_of_file(path_of("nosuch.sdf")), path_of("nosuch.sdf") + ": no such file");
  EXPECT_NE(error_of_file(path_of("")), "");
}

TEST_F(LoadWorldErrors, FilesThatAreNotSdf) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", ":1: not an XML file"},
      {"hello\n", ":1: not an XML file"},
      {"\n<robot name='r'/>", ":2: a URDF, not an SDF file (gz sdf -p FILE.urdf converts it)"},
      {"<a/>", ":1: not an SDF file: its root element is <a>, not <sdf>"},
      {"<sdf version='1.0'/>", ":1: SDF of version 1.0 is not read (1.2 and later are)"},
      {"<sdf version='1.6'>\n</sdf>", ":1: holds no world"},
      {"<sdf version='1.6'>\n<light name='l' type='point'/></sdf>", ":1: holds no world"}};
  for (const auto& [text, expected] : cases) {
    const std::string path = write("file.sdf", text);
    EXPECT_EQ(error_of_file(path), path + expected) << text;
  }
}

TEST_F(LoadWorldErrors, PrintNothing) {
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  for (const char* text : {"", "hello", "<robot/>", "<sdf version='1.6'><world></sdf>"}) {
    EXPECT_NE(error_of_file(write("file.sdf", text)), "");
  }
  EXPECT_NE(error_of(model_with("<box><size>1 1</size></box>")), "");
  EXPECT_EQ(testing::internal::GetCapturedStderr(), "");
  EXPECT_EQ(testing::internal::GetCapturedStdout(), "");
}

TEST_F(LoadWorldErrors, MalformedXml) {
  expect_error("<model name='m'>\n<link name='l'>\n</model>",
               "world.sdf:5: malformed XML: </model> where </link> was expected");
  expect_error("<model name='m'>", "world.sdf:4: malformed XML: </world>");
}

TEST_F(LoadWorldErrors, MalformedIncludedModel) {
  write("models/crate/model.config",
        "<model><name>crate</name><sdf version='1.6'>model.sdf</sdf></model>");
  write("models/crate/model.sdf", "<sdf version='1.6'>\n<model name='crate'>\n<link>\n</sdf>");
  expect_error("<include><uri>model://crate</uri></include>",
               "models/crate/model.sdf:4: malformed XML");
}

TEST_F(LoadWorldErrors, IncludedFolderWithoutAModel) {
  write("models/crate/model.config", "<model>\n<name");
  write("models/empty/readme", "");
  expect_error("<include>\n<uri>model://crate</uri></include>",
               "models/crate/model.config:2: malformed XML");
  expect_error("<include>\n<uri>model://empty</uri></include>", "world.sdf:4: no model file in '",
               "models/empty' (expected model.config");
}

TEST_F(LoadWorldErrors, IncludeThatCantBeFound) {
  expect_error("<include>\n<uri>model://nosuch</uri></include>",
               "world.sdf:4: can't find 'model://nosuch' (looked in ");
  expect_error("<include>\n<uri>nosuch</uri></include>", "world.sdf:4: can't find 'nosuch'");
}

TEST_F(LoadWorldErrors, AllIncludesThatCantBeFoundAtOnce) {
  write_model("shelf", "<link name='l'/>\n<include><uri>model://far</uri></include>");
  expect_error(
      "<include>\n<uri>model://near</uri></include><include><uri>model://near</uri>"
      "</include><include><uri>model://shelf</uri></include>",
      "world.sdf:4: can't find 'model://near', 'model://far' (",
      "models/shelf/model.sdf:3) (looked in ");
}

TEST_F(LoadWorldErrors, IncludesThatNeverEnd) {
  write_model("snake", "<link name='l'/>\n<include><uri>model://tail</uri></include>");
  write_model("tail", "<link name='l'/>\n<include><uri>model://snake</uri></include>");
  expect_error("<include><uri>model://snake</uri></include>", "",
               "models/tail/model.sdf:3: 'model://snake' includes itself");
  expect_error("<include><uri>world.sdf</uri></include>",
               "world.sdf:3: 'world.sdf' includes itself");
}

TEST_F(LoadWorldErrors, IncludesBeyondAllMeasure) {
  write_model("level0", "<link name='l'/>");
  for (int level = 1; level < 12; ++level) {
    const std::string below = "model://level" + std::to_string(level - 1) + "</uri></include>\n";
    std::string includes;
    for (int i = 0; i < 10; ++i) {
      includes += "<include><name>m" + std::to_string(i) + "</name><uri>" + below;
    }
    write_model("level" + std::to_string(level), includes);
  }
  expect_error("<include><uri>model://level11</uri></include>", "", "over 100000 models");
}

TEST_F(LoadWorldErrors, PoseThatIsNotFinite) {
  expect_error("<model name='m'>\n<pose>nan 0 0 0 0 0</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>");
  expect_error("<model name='m'>\n<pose>0 0 0 0 inf 0</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>");
}

TEST_F(LoadWorldErrors, PoseThatIsNotNumbers) {
  expect_error("<model name='m'>\n<pose>1 2 3 0 0 left</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>: '1 2 3 0 0 left'");
  expect_error("<model name='m'>\n<pose>1, 2, 3, 0, 0, 0</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>");
  expect_error(
      "<model name='m'>\n<pose rotation_format='quat_xyzw'>1 2 3 0 0 0</pose>"
      "<link name='l'/></model>",
      "world.sdf:4: missing or bad value in <pose>: '1 2 3 0 0 0' (expected 7 numbers)");
}

TEST_F(LoadWorldErrors, SizesThatAreNoNumbers) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"\n<box><size>1 1</size></box>",
       "missing or bad value in <size>: '1 1' (expected 3 numbers)"},
      {"\n<box><size>1 1 big</size></box>", "missing or bad value in <size>"},
      {"<box>\n<size>nan 2 1</size></box>", "missing or bad value in <size>"},
      {"<box>\n<size>1 2 inf</size></box>", "missing or bad value in <size>"},
      {"<sphere>\n<radius>nan</radius></sphere>", "missing or bad value in <radius>"},
      {"\n<plane><normal>0 0</normal></plane>", "missing or bad value in <normal>"},
      {"<polyline><point>0 0</point>\n<point>0</point></polyline>",
       "missing or bad value in <point>"}};
  for (const auto& [geometry, expected] : cases) {
    expect_error(model_with(geometry), "world.sdf:7: " + expected);
  }
}

TEST_F(LoadWorldErrors, FilesOfShapesThatAreMissingOrBroken) {
  write("broken.obj", "hello\n");
  write("broken.png", "hello\n");
  write("t.obj", kTriangleObj);
  expect_error(model_with("<mesh>\n<uri>nosuch.dae</uri></mesh>"),
               "world.sdf:7: can't find 'nosuch.dae'");
  expect_error(model_with("<mesh>\n<uri>model://a/b.dae</uri></mesh>"),
               "world.sdf:7: can't find 'model://a/b.dae'");
  expect_error(model_with("\n<mesh><uri>broken.obj</uri></mesh>"), "world.sdf:7: ", "broken.obj");
  expect_error(model_with("\n<mesh><uri>t.obj</uri><submesh><name>x</name></submesh></mesh>"),
               "world.sdf:7: ", "no part 'x'");
  expect_error(model_with("\n<heightmap><uri>broken.png</uri></heightmap>"),
               "world.sdf:7: ", "broken.png: not a PNG image");
}

TEST_F(LoadWorldErrors, MeshesAndIncludesThatCantBeFoundAreListedTogether) {
  expect_error("<include><uri>model://nosuch</uri></include>\n" +
                   model_with("<mesh>\n<uri>nosuch.dae</uri></mesh>"),
               "world.sdf:3: can't find 'model://nosuch', 'nosuch.dae' (");
}

TEST_F(LoadWorldErrors, FilesOutsideOfAllFolders) {
  write("t.obj", kTriangleObj);
  write("home/w.sdf", world(model_with("\n<mesh><uri>" + path_of("t.obj") + "</uri></mesh>")));
  const std::string error = error_of_file(path_of("home/w.sdf"));
  EXPECT_NE(error.find("w.sdf:7: '" + path_of("t.obj") + "' lies outside"), std::string::npos)
      << error;
  EXPECT_NE(
      error_of_file(write("home/v.sdf", world(model_with("\n<mesh><uri>../t.obj</uri></mesh>"))))
          .find("v.sdf:7: "),
      std::string::npos);
  WorldOptions options;
  options.allow_outside = true;
  EXPECT_EQ(load_world(path_of("home/w.sdf"), {}, diagnostics_, options).collisions.size(), 1U);
  EXPECT_EQ(load_file(path_of("home/w.sdf"), {path_of("")}).collisions.size(), 1U);
}

TEST_F(LoadWorldErrors, MissingName) {
  expect_error("\n<model><link name='l'/></model>", "world.sdf:4: <model> without a name");
  expect_error("<model name='m'>\n<link/></model>", "world.sdf:4: <link> without a name");
}

}  // namespace
}  // namespace tagfield
