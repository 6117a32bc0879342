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
      {"\n<robot name='r'/>", ":2: not an SDF file: its root element is <robot>, not <sdf>"},
      {"<sdf version='1.6'>\n</sdf>", ":1: holds no world"},
      {"<sdf version='1.6'>\n<light name='l' type='point'/></sdf>", ":1: holds no world"},
      {"<sdf><world name='w'/></sdf>", ":1: not readable as SDF (is its version missing?)"}};
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
  expect_error("<include><uri>model://level11</uri></include>", "",
               "over 20000 included models: more than fit into memory");
}

TEST_F(LoadWorldErrors, WorldsSavedWithModelsInModelsAreReadAll) {
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
  EXPECT_EQ(scene.collisions[0].name, "m::inner__body::c");
  ASSERT_FALSE(warnings().empty());
  EXPECT_NE(warnings()[0].find("names with '::'"), std::string::npos);
}

TEST_F(LoadWorldErrors, IncludeWithoutAUri) {
  expect_error("\n<include><name>x</name></include>", "world.sdf:4: <include> without <uri>");
}

TEST_F(LoadWorldErrors, RelativeUriOfTwoMeanings) {
  for (const char* name : {"one", "two"}) {
    write_model(name, "<link name='l'/>\n<include><uri>part.sdf</uri></include>");
    write("models/" + std::string(name) + "/part.sdf",
          "<sdf version='1.6'><model name='part'><link name='l'/></model></sdf>");
  }
  expect_error("<include><uri>model://one</uri></include><include><uri>model://two</uri></include>",
               "", "models/two/model.sdf:3: 'part.sdf' names ");
}

TEST_F(LoadWorldErrors, PoseRelativeToAnUnknownFrame) {
  const std::string link =
      "<link name='l'><collision name='c'>\n<pose relative_to='FRAME'>0 0 0 "
      "0 0 0</pose><geometry><sphere><radius>1</radius></sphere></geometry>"
      "</collision></link>";
  expect_error(
      "<model name='m'>\n<pose relative_to='nope'>1 0 0 0 0 0</pose>\n<link name='l'/>"
      "</model>",
      "world.sdf:4: model 'm' is relative_to 'nope'");
  expect_error(
      "<model name='m'>\n<link name='l'>\n<pose relative_to='nope'>1 0 0 0 0 0</pose>"
      "</link></model>",
      "world.sdf:5: link 'l' is relative_to 'nope'");
  expect_error("<model name='m'>\n" + link + "</model>",
               "world.sdf:5: can't tell where frame 'FRAME' is");
  expect_error("<frame name='f'>\n<pose relative_to='nope'/></frame>",
               "world.sdf:4: frame 'f' is relative_to 'nope'");
  expect_error("\n<frame name='f' attached_to='nope'/>", "world.sdf:4: frame 'f' is attached_to");
}

TEST_F(LoadWorldErrors, PoseThatIsNotFinite) {
  expect_error("<model name='m'>\n<pose>nan 0 0 0 0 0</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>");
  expect_error("<model name='m'>\n<pose>0 0 0 0 inf 0</pose><link name='l'/></model>",
               "world.sdf:4: missing or bad value in <pose>");
}

TEST_F(LoadWorldErrors, ShapesOfNoSize) {
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"\n<box/>", "world.sdf:7: <box> without <size>"},
      {"\n<box><size>1 1</size></box>", "world.sdf:7: missing or bad value in <size>"},
      {"\n<box><size>1 1 big</size></box>", "world.sdf:7: missing or bad value in <size>"},
      {"<box>\n<size>1 0 1</size></box>", "world.sdf:7: <size> of a box must be three positive"},
      {"<box>\n<size>1 -2 1</size></box>", "world.sdf:7: <size> of a box must be three positive"},
      {"<box>\n<size>nan 2 1</size></box>", "world.sdf:7: missing or bad value in <size>"},
      {"<box>\n<size>1 2 nan</size></box>", "world.sdf:7: missing or bad value in <size>"},
      {"<box>\n<size>1 2 inf</size></box>", "world.sdf:7: missing or bad value in <size>"},
      {"\n<sphere/>", "world.sdf:7: <sphere> without <radius>"},
      {"<sphere>\n<radius>0</radius></sphere>", "world.sdf:7: <radius> of a sphere must be"},
      {"<sphere>\n<radius>nan</radius></sphere>", "world.sdf:7: <radius> of a sphere must be"},
      {"\n<cylinder><radius>1</radius></cylinder>", "world.sdf:7: <cylinder> without <length>"},
      {"<cylinder><radius>1</radius>\n<length>-1</length></cylinder>",
       "world.sdf:7: <length> of a cylinder must be"},
      {"\n<plane><normal>0 0 0</normal></plane>", "world.sdf:7: <normal> of a plane"},
      {"\n<plane><normal>0 0 1</normal><size>-1 1</size></plane>",
       "world.sdf:7: <size> of a plane"},
      {"", "world.sdf:5: collision 'm::l::c' has no geometry"}};
  for (const auto& [geometry, expected] : cases) expect_error(model_with(geometry), expected);
}

TEST_F(LoadWorldErrors, CollisionWithoutGeometry) {
  expect_error("<model name='m'><link name='l'>\n<collision name='c'/></link></model>",
               "world.sdf:4: collision 'm::l::c' has no geometry");
}

TEST_F(LoadWorldErrors, MeshesThatAreMissingOrBroken) {
  write("broken.obj", "hello\n");
  write("t.obj", kTriangleObj);
  expect_error(model_with("\n<mesh/>"), "world.sdf:7: <mesh> without <uri>");
  expect_error(model_with("<mesh>\n<uri>nosuch.dae</uri></mesh>"),
               "world.sdf:7: can't find 'nosuch.dae'");
  expect_error(model_with("<mesh>\n<uri>model://a/b.dae</uri></mesh>"),
               "world.sdf:7: can't find 'model://a/b.dae'");
  expect_error(model_with("\n<mesh><uri>broken.obj</uri></mesh>"), "world.sdf:7: ", "broken.obj");
  expect_error(model_with("\n<mesh><uri>t.obj</uri><scale>1 0 1</scale></mesh>"),
               "world.sdf:7: <scale> of a mesh");
  expect_error(model_with("\n<mesh><uri>t.obj</uri><submesh><name>x</name></submesh></mesh>"),
               "world.sdf:7: ", "no part 'x'");
}

TEST_F(LoadWorldErrors, SecondOfTheSameName) {
  const std::string collision =
      "<collision name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>\n";
  expect_error("<model name='m'><link name='l'>\n" + collision + collision + "</link></model>",
               "world.sdf:5: a second <collision> named 'c'");
  expect_error("<model name='m'><link name='l'/></model>\n<model name='m'><link name='l'/></model>",
               "world.sdf:4: a second <model> named 'm'");
}

TEST_F(LoadWorldErrors, MissingName) {
  expect_error("\n<model><link name='l'/></model>", "world.sdf:4: Required attribute[name]");
}

}  // namespace
}  // namespace tagfield
